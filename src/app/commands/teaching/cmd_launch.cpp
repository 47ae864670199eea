#include "commands/teaching/cmd_launch.h"

#include <chrono>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <thread>

#include "commands/pictures/window_exercise.h"
#include "commands/support/cli_support.h"
#include "commands/support/parser.h"
#include "commands/teaching/scenario_run.h"
#include "exercises/launched_exercise.h"
#include "exercises/result_files.h"
#include "exercises/seat_files.h"
#include "osteon/base/file.h"

namespace osteon {
namespace {

struct LaunchCommand {
  std::string address, surgeon, certificates;
  double timeout_s = 20;
  bool waiting = false, json = false;
};

Cmi5Way way_of(const LaunchCommand& command) {
  return {command.certificates, static_cast<long>(command.timeout_s * 1000),
          [](long ms) { std::this_thread::sleep_for(std::chrono::milliseconds(ms)); }};
}

// An address names a shipped exercise; a file of that name in the folder is not looked at.
Result<Scenario> shipped_exercise(const std::string& name) {
  auto all = shipped_scenarios();
  if (!all) return tl::unexpected(all.error());
  for (Scenario& one : *all)
    if (one.name == name) return std::move(one);
  return fail("there is no exercise '" + name + "'", "launch address", "See: osteon scenario list");
}

Result<std::optional<AttemptRow>> played_by_surgeon(const std::string& surgeon,
                                                    const Cmi5Launch& launch,
                                                    const std::string& learner) {
  auto scenario = shipped_exercise(launch.scenario);
  if (!scenario) return tl::unexpected(scenario.error());
  auto skill = parse_skill(*scenario, surgeon);
  if (!skill) return tl::unexpected(skill.error());
  auto standard = standard_in_use(scenario->name);
  if (!standard) return tl::unexpected(standard.error());
  ScenarioRun run;
  run.case_spec = case_spec_of(*scenario, "", launch.seed);
  run.scenario = std::move(*scenario);
  run.standard = std::move(*standard);
  run.skill = std::move(*skill);
  const auto done = run_scenario(run);
  if (!done) return tl::unexpected(done.error());
  const auto row = row_from_report(to_json(*done), learner);
  if (!row) return tl::unexpected(row.error());
  const auto kept = keep_attempt(*row, results_place(), waiting_folder());
  if (!kept) return tl::unexpected(kept.error());
  if (kept->why_waiting) report_error(*kept->why_waiting);
  return std::optional<AttemptRow>(*row);
}

// Attempts of a learner that have ended since: in the results, or where they wait for them.
std::vector<AttemptRow> attempts_since(std::int64_t began_ms, const std::string& scenario,
                                       const std::string& learner) {
  std::vector<AttemptRow> rows;
  if (const auto store = open_results())
    if (auto listed = store->list({learner, scenario})) rows = std::move(*listed);
  constexpr std::uint64_t kLargestAttempt = 64u << 20;
  std::error_code ec;
  for (std::filesystem::directory_iterator at(waiting_folder(), ec), end; !ec && at != end;
       at.increment(ec))
    if (const auto text = read_file(at->path(), kLargestAttempt))
      if (auto row = parse_attempt_row(*text, at->path().string());
          row && row->learner == learner && row->scenario == scenario)
        rows.push_back(std::move(*row));
  std::erase_if(rows, [&](const AttemptRow& row) { return row.ended_ms < began_ms; });
  return rows;
}

// The window keeps its attempts itself, also where it is ended by a signal. One that passed counts
// before a later one that did not.
Result<std::optional<AttemptRow>> played_in_window(const Cmi5Launch& launch,
                                                   const std::string& learner) {
  const auto since = std::chrono::system_clock::now().time_since_epoch();
  const auto began = std::chrono::duration_cast<std::chrono::milliseconds>(since).count();
  const auto shown = exercise_in_window(launch.scenario, launch.seed, learner);
  std::optional<AttemptRow> counts;
  for (AttemptRow& row : attempts_since(began, launch.scenario, learner))
    if (!counts || counts->verdict != "passed") counts = std::move(row);
  if (!counts && !shown) return tl::unexpected(shown.error());
  return counts;
}

nlohmann::ordered_json sent_words(const Cmi5Sent& sent) {
  nlohmann::ordered_json json = {
      {"accepted", sent.accepted}, {"waiting", sent.waiting}, {"refusals", sent.refusals}};
  json["why_waiting"] = sent.why_waiting ? nlohmann::ordered_json(sent.why_waiting->message())
                                         : nlohmann::ordered_json(nullptr);
  return json;
}

// What a server answered may be no UTF-8.
std::string printable(const nlohmann::ordered_json& json) {
  return json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
}

void say_sent(const Cmi5Sent& sent) {
  std::printf("statements    %zu accepted, %zu refused, %zu waiting\n", sent.accepted,
              sent.refusals.size(), sent.waiting);
  for (const std::string& refusal : sent.refusals)
    std::printf("refused       %s\n", refusal.c_str());
  if (sent.why_waiting)
    std::fprintf(stderr, "osteon: %s; see: osteon launch --waiting\n",
                 sent.why_waiting->message().c_str());
}

bool all_told(const Cmi5Sent& sent) { return sent.waiting == 0 && sent.refusals.empty(); }

int send_waiting(const LaunchCommand& command) {
  const auto sent = send_cmi5(launches_folder(), way_of(command));
  if (!sent) return report_error(sent.error());
  if (command.json)
    std::printf("%s\n", printable(sent_words(*sent)).c_str());
  else
    say_sent(*sent);
  return all_told(*sent) ? kExitDone : kExitNo;
}

void say_launched(const LaunchedExercise& done) {
  std::printf("attempt       %s\n", done.attempt ? done.attempt->verdict.c_str() : "none");
  if (done.attempt && done.attempt->score)
    std::printf("score         %.1f\n", *done.attempt->score);
  if (!done.counts) std::printf("opened to look at only, so nothing is judged\n");
  say_sent(done.sent);
  if (!done.return_url.empty()) std::printf("go on at      %s\n", done.return_url.c_str());
}

int launch_command(const LaunchCommand& command) {
  if (command.waiting) return send_waiting(command);
  const auto launch = parse_cmi5_launch(command.address);
  if (!launch) return report_error(launch.error());
  // Before the token is used up.
  const auto scenario = shipped_exercise(launch->scenario);
  if (!scenario) return report_error(scenario.error());
  if (!command.surgeon.empty())
    if (const auto skill = parse_skill(*scenario, command.surgeon); !skill)
      return report_error(skill.error());
  const auto done = run_launched(
      *launch, way_of(command), [&](const Cmi5Launch& order, const std::string& learner) {
        return command.surgeon.empty() ? played_in_window(order, learner)
                                       : played_by_surgeon(command.surgeon, order, learner);
      });
  if (!done) return report_error(done.error());
  if (command.json) {
    nlohmann::ordered_json json = sent_words(done->sent);
    json["verdict"] = done->attempt ? nlohmann::ordered_json(done->attempt->verdict)
                                    : nlohmann::ordered_json(nullptr);
    json["return_url"] = done->return_url;
    std::printf("%s\n", printable(json).c_str());
  } else {
    say_launched(*done);
  }
  if (done->not_played) return report_error(*done->not_played);
  const bool passed = done->attempt && done->attempt->verdict == "passed";
  return passed && all_told(done->sent) ? kExitDone : kExitNo;
}

}  // namespace

void add_launch_command(cli::App& app, int& exit_code) {
  auto options = std::make_shared<LaunchCommand>();
  cli::App* command = app.add_subcommand(
      "launch",
      "Do the exercise that a learning management system launches (cmi5), and report the result to "
      "it.\nExit code: 0 passed and reported, 1 not passed or not reported, 2 could not be done");
  command->add_option("address", options->address,
                      "osteon://launch/SCENARIO?endpoint=...&fetch=...&actor=...&registration=...&"
                      "activityId=...");
  command->add_option("--surgeon", options->surgeon,
                      "virtual surgeon who does it without a window, as in `osteon run`; default: "
                      "you do it, in the window");
  command->add_flag("--waiting", options->waiting,
                    "only send the results that earlier launches could not send");
  command->add_option("--certificates", options->certificates,
                      "PEM file of trusted certificate authorities; default: the system's");
  command->add_option("--timeout", options->timeout_s, "time limit of one request, s")
      ->check(cli::Range(0.1, 600.0))
      ->capture_default_str();
  command->add_flag("--json", options->json, "print JSON");
  command->callback([options, &exit_code] {
    if (options->address.empty() != options->waiting)
      cli::refuse("launch", "give an address, or --waiting");
    exit_code = launch_command(*options);
  });
}

}  // namespace osteon
