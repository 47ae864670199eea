#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include "commands/support/parser.h"

#include "cases/open_case.h"
#include "commands/support/cli_support.h"
#include "commands/support/commands.h"
#include "commands/support/headless.h"
#include "commands/support/session_options.h"
#include "osteon/base/file.h"
#include "osteon/procedure/hand_reports.h"

namespace osteon {
namespace {

struct SimulateOptions {
  std::string case_spec = "builtin:wrist";
  std::string path;
  std::vector<std::string> hands;
  std::string record;
  std::string report;
  std::string device;
  bool structures = false;
  SessionOptions session;
};

// "left=L.csv".
Result<HeadlessHand> hand_named(const std::string& text) {
  const auto equals = text.find('=');
  if (equals == std::string::npos || equals == 0 || equals + 1 == text.size())
    return fail("a hand is given as NAME=PATH.csv", text, "For example: --hand left=left.csv");
  auto path = load_path(text.substr(equals + 1));
  if (!path) return tl::unexpected(path.error());
  return HeadlessHand{text.substr(0, equals), std::move(*path)};
}

Result<HeadlessRun> run_of(const SimulateOptions& options) {
  HeadlessRun run;
  for (const std::string& text : options.hands) {
    auto hand = hand_named(text);
    if (!hand) return tl::unexpected(hand.error());
    run.hands.push_back(std::move(*hand));
  }
  if (run.hands.size() > kMaxHands)
    return fail("a session has at most four hands", "--hand", "Give fewer");
  if (!run.hands.empty() && !options.device.empty())
    return fail("cannot be combined with --hand: a device plays one path", "--device",
                "Leave out one of them");
  if (run.hands.empty()) {
    auto path = load_path(options.path);
    if (!path) return tl::unexpected(path.error());
    run.path = std::move(*path);
  }
  run.case_source = options.case_spec;
  auto settings = options.session.resolved();
  if (!settings) return tl::unexpected(settings.error());
  run.settings = std::move(*settings);
  run.hand = options.session.hand;
  run.device = options.device;
  if (!options.record.empty()) run.record_to = options.record;
  return run;
}

int print_hands(const HeadlessOutcome& outcome, const std::string& report_file) {
  std::string text =
      with_torque(to_json(outcome.reports, outcome.names), outcome.torques, outcome.names);
  if (outcome.softs) {
    auto json = nlohmann::ordered_json::parse(text);
    json["soft"] = to_json(*outcome.softs);
    text = json.dump(2) + "\n";
  }
  if (!report_file.empty())
    if (auto ok = write_file_atomic(report_file, text); !ok) return report_error(ok.error());
  for (std::size_t h = 0; h < outcome.reports.size(); ++h)
    std::printf("hand           %s\n%s%s\n", outcome.names[h].c_str(),
                h < outcome.torques.size() ? to_text(outcome.torques[h]).c_str() : "",
                to_text(outcome.reports[h]).c_str());
  if (outcome.softs) std::fputs(to_text(*outcome.softs).c_str(), stdout);
  return kExitDone;
}

// What was carved, what the grip bore, and what is soft, are more parts of the report.
Result<void> save_with_more(const Report& report, const HeadlessOutcome& outcome,
                            const std::string& file) {
  if (file.empty() || !(outcome.carving || outcome.softs || !outcome.torques.empty()))
    return save_report(report, file);
  auto json = nlohmann::ordered_json::parse(with_torque(to_json(report), outcome.torques, {}));
  if (outcome.carving) json["carving"] = to_json(*outcome.carving);
  if (outcome.softs) json["soft"] = to_json(*outcome.softs);
  return write_file_atomic(file, json.dump(2) + "\n");
}

int run_simulate(const SimulateOptions& options) {
  if (options.path.empty() == options.hands.empty())
    return report_error({"give either --path or --hand", "simulate",
                         "Give --path PATH.csv, or --hand NAME=PATH.csv for each hand"});
  auto run = run_of(options);
  if (!run) return report_error(run.error());
  auto the_case = open_and_show_progress(
      options.case_spec,
      options.session.soft.empty() && !options.structures ? CaseParts::kFelt : CaseParts::kAll);
  if (!the_case) return report_error(the_case.error());
  run->the_case = *the_case;
  const auto outcome = simulate_hands(*run);
  if (!outcome) return report_error(outcome.error());
  if (!options.hands.empty()) return print_hands(*outcome, options.report);
  const Report& report = outcome->reports.front();
  if (auto ok = save_with_more(report, *outcome, options.report); !ok)
    return report_error(ok.error());
  if (!outcome->torques.empty()) std::fputs(to_text(outcome->torques.front()).c_str(), stdout);
  std::fputs(to_text(report).c_str(), stdout);
  if (outcome->carving) std::fputs(to_text(*outcome->carving).c_str(), stdout);
  if (outcome->softs) std::fputs(to_text(*outcome->softs).c_str(), stdout);
  return kExitDone;
}

}  // namespace

void add_simulate_command(cli::App& app, int& exit_code) {
  auto options = std::make_shared<SimulateOptions>();
  cli::App* command = app.add_subcommand(
      "simulate", "Drive the virtual hand along a path, without a window, as fast as possible");
  command->add_option("--case", options->case_spec, "a case folder, builtin:wrist or builtin:knee")
      ->capture_default_str();
  command->add_option("--path", options->path, "probe path, CSV");
  command->add_option("--hand", options->hands, "NAME=PATH.csv; may be given for up to four hands");
  command->add_option("--record", options->record, "write a recording (.osr)");
  command->add_option("--report", options->report, "write the report as JSON");
  command->add_option("--device", options->device,
                      "play the path on a virtual device, through its driver and the safety gate: "
                      "virtual-usb-vector, virtual-usb-torque, virtual-usb-pid, virtual");
  options->session.add_to(*command);
  add_structures_option(*command, options->structures);
  command->callback([options, &exit_code] { exit_code = run_simulate(*options); });
}

}  // namespace osteon
