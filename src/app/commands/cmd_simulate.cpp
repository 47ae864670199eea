#include <CLI/CLI.hpp>
#include <cstdio>
#include <memory>
#include <string>

#include "cases/open_case.h"
#include "commands/cli_support.h"
#include "commands/commands.h"
#include "commands/headless.h"
#include "commands/session_options.h"

namespace osteon {
namespace {

struct SimulateOptions {
  std::string case_spec = "builtin:wrist";
  std::string path;
  std::string record;
  std::string report;
  std::string device;
  SessionOptions session;
};

int run_simulate(const SimulateOptions& options) {
  auto path = load_path(options.path);
  if (!path) return report_error(path.error());
  auto the_case = open_and_show_progress(options.case_spec, CaseParts::kFelt);
  if (!the_case) return report_error(the_case.error());
  HeadlessRun run;
  run.the_case = *the_case;
  run.case_source = options.case_spec;
  run.path = std::move(*path);
  run.settings = options.session.resolved();
  run.hand = options.session.hand;
  run.device = options.device;
  if (!options.record.empty()) run.record_to = options.record;
  const auto report = simulate(run);
  if (!report) return report_error(report.error());
  if (auto ok = save_report(*report, options.report); !ok) return report_error(ok.error());
  std::fputs(to_text(*report).c_str(), stdout);
  return kExitDone;
}

}  // namespace

void add_simulate_command(CLI::App& app, int& exit_code) {
  auto options = std::make_shared<SimulateOptions>();
  CLI::App* command = app.add_subcommand(
      "simulate", "Drive the virtual hand along a path, without a window, as fast as it goes");
  command->add_option("--case", options->case_spec, "a case folder, builtin:wrist or builtin:knee")
      ->capture_default_str();
  command->add_option("--path", options->path, "probe path, CSV")->required();
  command->add_option("--record", options->record, "write a recording (.osr)");
  command->add_option("--report", options->report, "write the report as JSON");
  command->add_option("--device", options->device,
                      "play the path on a virtual device, through its driver and the safety gate: "
                      "virtual-usb-vector, virtual-usb-pid, virtual");
  options->session.add_to(*command);
  command->callback([options, &exit_code] { exit_code = run_simulate(*options); });
}

}  // namespace osteon
