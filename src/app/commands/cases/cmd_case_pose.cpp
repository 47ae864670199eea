#include <cstdio>
#include <memory>
#include <stdexcept>
#include <string>
#include "commands/support/parser.h"

#include "cases/felt_choice.h"
#include "cases/noted_case.h"
#include "cases/open_case.h"
#include "cases/whole_folder.h"
#include "commands/support/cli_support.h"
#include "commands/support/commands.h"
#include "commands/support/progress_line.h"

namespace osteon {
namespace {

struct CasePoseCommand {
  std::string spec, out;
  double flexion_deg = 0;
};

int run_pose(const CasePoseCommand& command) {
  const auto out = plain_folder(command.out);
  if (const auto free = refuse_existing(out); !free) return report_error(free.error());
  const auto spec = bent_spec(command.spec, "flexion", command.flexion_deg);
  if (!spec) return report_error(spec.error());
  ProgressLine line;
  const auto def = open_case_def(*spec, [say = line.callback()](double share) {
    if (!say("Generating the bones", share))
      throw std::runtime_error("stopped; nothing was written");
  });
  if (!def) return report_error(def.error());
  const auto notes = notes_of(command.spec);
  if (!notes) return report_error(notes.error());
  const auto saved = save_noted_case(*def, *notes, out);
  if (!saved) return report_error(saved.error());
  std::printf("bent to %g degrees -> %s\n", command.flexion_deg, out.string().c_str());
  return kExitDone;
}

}  // namespace

void add_case_pose(cli::App& group, int& exit_code) {
  cli::App* pose =
      group.add_subcommand("pose", "Bend the joint of a case and save the result as a new case");
  auto command = std::make_shared<CasePoseCommand>();
  pose->add_option("case", command->spec, "case folder of a generated knee, or builtin:knee")
      ->required();
  pose->add_option("--flexion", command->flexion_deg, "flexion, degrees; 0 is straight")
      ->required();
  pose->add_option("--out", command->out, "the case folder to make")->required();
  pose->callback([command, &exit_code] { exit_code = run_pose(*command); });
}

}  // namespace osteon
