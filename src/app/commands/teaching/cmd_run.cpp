#include <cstdio>
#include <memory>
#include <string>
#include "commands/support/parser.h"

#include "commands/support/cli_support.h"
#include "commands/support/commands.h"
#include "commands/teaching/scenario_run.h"
#include "exercises/ghost/ghost_file.h"
#include "exercises/graft_order.h"
#include "exercises/portal_choice.h"
#include "exercises/result_files.h"
#include "exercises/result_sender.h"
#include "exercises/seat_files.h"
#include "loops/stop_signal.h"
#include "osteon/base/file.h"
#include "osteon/device/drivers.h"
#include "runs/hands/hand_order.h"
#include "runs/reports/exam_report.h"
#include "runs/reports/portal_report.h"

namespace osteon {
namespace {

struct RunCommand {
  std::string scenario, case_spec, surgeon = "expert", record, report, standard, findings, graft,
                                   portals, to_stage, way;
  std::string learner = "local";
  std::vector<std::string> devices;
  bool no_store = false, live = false;
  std::optional<std::uint64_t> seed;
};

Result<std::optional<Standard>> standard_of(const RunCommand& command, const Scenario& scenario) {
  if (command.standard.empty()) return standard_in_use(scenario.name);
  auto standard = load_standard(command.standard);
  if (!standard) return tl::unexpected(standard.error());
  return std::optional<Standard>(std::move(*standard));
}

// The devices of a live run, as other commands name them.
Result<std::shared_ptr<std::vector<LedDevice>>> open_devices(const RunCommand& command) {
  auto devices = std::make_shared<std::vector<LedDevice>>();
  std::vector<DeviceChoice> taken;
  for (const std::string& text : command.devices) {
    const HandOrder order = parse_hand_order(text);
    if (!order.instrument.empty())
      return fail("what a hand holds is told by the exercise", text,
                  "Leave out =" + order.instrument);
    auto choice = choice_of(order, taken);
    if (!choice) return tl::unexpected(choice.error());
    for (const Driver& driver : drivers()) {
      if (choice->driver != driver.name) continue;
      auto device = driver.open(choice->info);
      if (!device) return tl::unexpected(device.error());
      devices->push_back({key_of(*choice), std::move(*device)});
    }
    taken.push_back(std::move(*choice));
  }
  return devices;
}

Result<ScenarioRun> ordered_run(const RunCommand& command) {
  auto scenario = open_scenario(command.scenario);
  if (!scenario) return tl::unexpected(scenario.error());
  auto skill = parse_skill(*scenario, command.surgeon);
  if (!skill) return tl::unexpected(skill.error());
  auto standard = standard_of(command, *scenario);
  if (!standard) return tl::unexpected(standard.error());
  ScenarioRun run;
  if (!command.findings.empty()) {
    const auto text = read_file(command.findings, 1u << 20);
    if (!text) return tl::unexpected(text.error());
    auto stated = parse_findings(*text, scenario->asks, command.findings);
    if (!stated) return tl::unexpected(stated.error());
    run.stated = std::move(*stated);
  }
  if (!command.graft.empty()) {
    auto text = read_file(command.graft, 16u << 20);
    if (!text) return tl::unexpected(text.error());
    run.graft_json = std::move(*text);
    leave_out_bench_stages(*scenario);
  }
  run.case_spec = case_spec_of(*scenario, command.case_spec, command.seed);
  if (!command.portals.empty()) {
    const auto text = read_file(command.portals, 16u << 20);
    if (!text) return tl::unexpected(text.error());
    const auto made = read_portals(*text, command.portals);
    if (!made) return tl::unexpected(made.error());
    auto spec = with_made_portals(run.case_spec, *made, command.portals);
    if (!spec) return tl::unexpected(spec.error());
    run.case_spec = std::move(*spec);
  }
  leave_out_what_case_has(*scenario, run.case_spec);
  run.scenario = std::move(*scenario);
  run.standard = std::move(*standard);
  run.skill = std::move(*skill);
  run.to_stage = command.to_stage;
  run.keeps_way = !command.way.empty();
  if (!command.record.empty()) run.record_to = command.record;
  if (!command.live) return run;
  auto devices = open_devices(command);
  if (!devices) return tl::unexpected(devices.error());
  run.live = std::move(*devices);
  return run;
}

// A live run that was broken off is kept as far as it went; its verdict is no answer.
int exit_code_of(const ScenarioOutcome& done) {
  if (done.live && stop_signal()) return 128 + stop_signal();
  if (done.live && !done.live->broken_off.empty())
    return report_error({done.live->broken_off, "the run was broken off",
                         "All forces are zero. What was done up to then is kept"});
  if (!done.identical)
    return report_error({"the recording does not repeat", "live run",
                         "Report this with the "
                         "recording"});
  return done.outcome.verdict == Verdict::kPassed ? kExitDone : kExitNo;
}

// Beside a recording, so that who shows this surgeon need not repeat it first. One who does not
// pass is no example.
Result<void> keep_way(const RunCommand& command, const ScenarioOutcome& done) {
  const std::uint64_t key = ghost_key(command.record);
  const bool example = done.way && !done.way->stretches.empty() && key != 0 &&
                       done.outcome.verdict != Verdict::kNotPassed;
  return example ? write_file_atomic(command.way, to_bytes(*done.way, key)) : Result<void>();
}

int run_command(const RunCommand& command) {
  std::optional<StopSignals> signals;
  if (command.live) signals.emplace();
  if (!command.live && !command.devices.empty())
    return report_error({"a device is for a live run", "--device", "Add --live"});
  if (!command.way.empty() && (command.record.empty() || command.live))
    return report_error({"a way is kept beside a recording, not of a live run", "--way",
                         "Add --record, without --live"});
  if (!is_learner_id(command.learner))
    return report_error({"'" + command.learner + "' is not a valid learner's id", "--learner",
                         "Use 1 to 64 letters, digits, '.', '_' and '-'"});
  const auto run = ordered_run(command);
  if (!run) return report_error(run.error());
  const auto done = run_scenario(*run);
  if (!done) return report_error(done.error());
  // Told before it is kept: on a full disk it would be lost.
  std::fputs(to_text(done->outcome).c_str(), stdout);
  if (done->acl) std::fputs(to_text(*done->acl).c_str(), stdout);
  if (done->graft) std::fputs(to_text(*done->graft).c_str(), stdout);
  if (done->placing) std::fputs(to_text(*done->placing).c_str(), stdout);
  std::fputs(portals_text(done->made_portals, *done->the_case).c_str(), stdout);
  if (done->exam) std::fputs(to_text(*done->exam).c_str(), stdout);
  if (done->live) std::fputs(to_text(*done->live).c_str(), stdout);
  if (!done->not_measured.empty()) std::printf("not measured  %s\n", done->not_measured.c_str());
  for (const std::string& bone : done->unreachable) std::printf("no way to     %s\n", bone.c_str());
  std::fflush(stdout);
  const std::string report = to_json(*done);
  if (!command.report.empty())
    if (auto ok = write_file_atomic(command.report, report); !ok) return report_error(ok.error());
  if (!command.way.empty())
    if (auto ok = keep_way(command, *done); !ok) return report_error(ok.error());
  if (!command.no_store) {
    const auto kept = keep_report(report, command.learner, command.record);
    if (!kept) return report_error(kept.error());
    if (*kept) std::fprintf(stderr, "osteon: %s\n", (*kept)->message().c_str());
    (void)send_results_in_background();
  }
  return exit_code_of(*done);
}

}  // namespace

void add_run_command(cli::App& app, int& exit_code) {
  auto options = std::make_shared<RunCommand>();
  cli::App* command =
      app.add_subcommand("run",
                         "Let a virtual surgeon play a scenario, without a window, and judge it.\n"
                         "Exit code: 0 passed, 1 not passed or undecided, 2 could not run");
  command->add_option("scenario", options->scenario, "name (see: scenario list) or file")
      ->required();
  auto* case_option = command->add_option(
      "--case", options->case_spec,
      "a case folder or builtin:wrist; default: the built-in case of its anatomy");
  command->add_option("--seed", options->seed, "seed of a random patient")->excludes(case_option);
  command
      ->add_option("--surgeon", options->surgeon,
                   "expert, novice, novice:SEED, or bad:NAME, who makes the error NAME")
      ->capture_default_str();
  command->add_option("--standard", options->standard,
                      "standard to judge against, TOML; default: the bundled one");
  command->add_option("--findings", options->findings,
                      "JSON file with the findings to report, such as {\"geissler\": \"3\"}; "
                      "default: the surgeon's own");
  command->add_option("--graft", options->graft,
                      "report of a run of acl_graft: its graft is placed in acl, and the stages at "
                      "the bench are left out");
  command->add_option("--portals", options->portals,
                      "report of a run of acl_puncture on the same patient: the portals of acl are "
                      "where they were made");
  command->add_option("--to-stage", options->to_stage,
                      "end when this stage is done; judged up to it, without a score");
  command->add_flag("--live", options->live,
                    "play it in real time on the devices that --device names");
  command->add_option("--device", options->devices,
                      "with --live: driver or driver:serial of a device whose user is emulated; "
                      "one for each hand, in the exercise's order; the last serves the hands that "
                      "are left, one after the other");
  command->add_option("--learner", options->learner, "local id under which the attempt is stored")
      ->capture_default_str();
  command->add_flag("--no-store", options->no_store, "do not store the attempt");
  command->add_option("--record", options->record, "write a recording (.osr)");
  command->add_option("--way", options->way,
                      "with --record: write the surgeon's way, which the window shows beside a "
                      "learner without repeating the recording first");
  command->add_option("--report", options->report, "write the report as JSON");
  command->callback([options, &exit_code] { exit_code = run_command(*options); });
}

}  // namespace osteon
