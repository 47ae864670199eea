#include <cstdio>
#include <memory>
#include <string>
#include "commands/support/parser.h"

#include "cases/open_case.h"
#include "commands/support/cli_support.h"
#include "commands/support/commands.h"
#include "osteon/scene/survey.h"
#include "osteon/scene/tool.h"

namespace osteon {
namespace {

struct SurveyCommand {
  std::string case_spec = "builtin:wrist";
  std::string out;
  SurveyOptions options;
};

std::string join(const std::vector<std::string>& names) {
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : ", ") + name;
  return text;
}

int run_survey(const SurveyCommand& command) {
  auto the_case = open_and_show_progress(command.case_spec, CaseParts::kFelt);
  if (!the_case) return report_error(the_case.error());
  const Survey survey = make_survey(**the_case, make_wrist_probe(), command.options);
  if (survey.path.samples.empty())
    return report_error({"no bone can be reached in a straight line from outside",
                         command.case_spec, "Check the case with: osteon case check"});
  if (auto ok = save_path(survey.path, command.out); !ok) return report_error(ok.error());
  std::printf("%zu bones in %.1f s: %s\n", survey.visited.size(), survey.path.duration_s(),
              join(survey.visited).c_str());
  if (!survey.unreachable.empty())
    std::printf("without a free straight approach: %s\n", join(survey.unreachable).c_str());
  return kExitDone;
}

}  // namespace

void add_path_commands(cli::App& app, int& exit_code) {
  cli::App* group = app.add_subcommand("path", "Make probe paths");
  group->require_subcommand(1);
  auto survey = std::make_shared<SurveyCommand>();
  cli::App* command = group->add_subcommand(
      "survey",
      "Make a path that visits every bone in reach: press along the normal, stroke, retreat");
  command->add_option("--case", survey->case_spec, "a case folder, builtin:wrist or builtin:knee")
      ->capture_default_str();
  command->add_option("--seed", survey->options.seed, "seed for choosing the places")
      ->capture_default_str();
  command->add_option("--force", survey->options.press_n, "target force, N")
      ->check(cli::Range(0.1, 20.0))
      ->capture_default_str();
  command->add_option("--out", survey->out, "probe path to write, CSV")->required();
  command->callback([survey, &exit_code] { exit_code = run_survey(*survey); });
}

}  // namespace osteon
