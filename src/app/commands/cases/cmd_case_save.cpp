#include <cstdio>
#include <memory>
#include <string>

#include "cases/noted_case.h"
#include "cases/whole_folder.h"
#include "commands/cases/carved_case.h"
#include "commands/support/cli_support.h"
#include "commands/support/commands.h"
#include "commands/support/number_check.h"
#include "commands/support/parser.h"

namespace osteon {
namespace {

struct CaseSaveCommand {
  std::string recording, case_spec, out;
  double at_s = 0;
};

int run_save(const CaseSaveCommand& command) {
  const auto out = plain_folder(command.out);
  if (const auto free = refuse_existing(out); !free) return report_error(free.error());
  const auto carved = carved_case(command.recording, command.case_spec, command.at_s);
  if (!carved) return report_error(carved.error());
  const auto notes = notes_of(carved->spec);
  if (!notes) return report_error(notes.error());
  const auto saved = save_noted_case(carved->def, *notes, out);
  if (!saved) return report_error(saved.error());
  std::string what =
      std::to_string(carved->carved) + " carved bone" + (carved->carved == 1 ? "" : "s");
  if (carved->pieces > 0)
    what += " and " + std::to_string(carved->pieces) + " loose piece" +
            (carved->pieces == 1 ? "" : "s");
  std::printf("%s at %g s -> %s\n", what.c_str(), command.at_s, out.string().c_str());
  return kExitDone;
}

}  // namespace

void add_case_save(cli::App& group, int& exit_code) {
  cli::App* save =
      group.add_subcommand("save", "Save the bones of a recording at a given moment as a new case");
  auto command = std::make_shared<CaseSaveCommand>();
  save->add_option("recording", command->recording, "a recording (.osr)")->required();
  save->add_option("--at", command->at_s, "seconds from the recording's start")
      ->required()
      ->check(refuse_negative);
  save->add_option("--case", command->case_spec, "the case; default: the recording's own");
  save->add_option("--out", command->out, "the case folder to make")->required();
  save->callback([command, &exit_code] { exit_code = run_save(*command); });
}

}  // namespace osteon
