#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>
#include "commands/support/parser.h"

#include "cases/open_case.h"
#include "commands/recordings/record_names.h"
#include "commands/support/cli_support.h"
#include "commands/support/commands.h"
#include "commands/support/frames.h"
#include "commands/support/headless.h"
#include "commands/support/session_options.h"
#include "osteon/base/file.h"
#include "osteon/procedure/hand_reports.h"
#include "runs/hands/tray.h"
#include "runs/replays/recorded_case.h"
#include "runs/replays/tick_work.h"
#include "runs/reports/torque_report.h"

namespace osteon {
namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t kLargestExpectation = 16 << 20;  // bytes

struct ReplayArguments {
  std::string file;
  std::string case_spec;
  std::string expect;
  std::string report;
  std::string frames;
  double from_s = 0;
  int runs = 1;
  bool allow_incomplete = false;
  SessionOptions session;
};

constexpr int kExitIncomplete = 3;

int print_deviations(const Report& report, const std::string& expect_file) {
  const auto expectation = read_file(expect_file, kLargestExpectation);
  if (!expectation) return report_error(expectation.error());
  auto deviations = check_expectation(report, *expectation);
  if (!deviations) {
    Error error = deviations.error();
    error.where = expect_file;
    return report_error(error);
  }
  for (const std::string& line : *deviations) std::printf("not as expected: %s\n", line.c_str());
  if (deviations->empty()) std::printf("as expected\n");
  return deviations->empty() ? kExitDone : kExitNo;
}

Result<std::unique_ptr<FrameWriter>> frames_for(const ReplayArguments& options,
                                                const Case& the_case) {
  if (options.frames.empty()) return std::unique_ptr<FrameWriter>();
  auto made = FrameWriter::create(the_case, options.frames);
  if (!made) return tl::unexpected(made.error());
  return std::make_unique<FrameWriter>(std::move(*made));
}

void print_difference(const ReplayOutcome& outcome) {
  std::printf("DIFFERENT from the recording at tick %llu (%.3f s)%s\n",
              static_cast<unsigned long long>(outcome.first_different_tick),
              static_cast<double>(outcome.first_different_tick) * 1e-3,
              outcome.reports.size() > 1
                  ? (" of hand " + std::to_string(outcome.first_different_hand + 1)).c_str()
                  : "");
}

// What was repeated agrees; whether that is all that was done is another question.
int judge(const ReplayArguments& options, const ReplayOutcome& outcome) {
  if (!outcome.identical) {
    print_difference(outcome);
    return kExitNo;
  }
  if (outcome.ticks == 0) {
    std::printf("%snothing was replayed: %s\n",
                outcome.complete ? "" : "incomplete: the recording is truncated; ",
                options.from_s > 0 ? "the recording ends before" : "the recording holds no ticks");
    return outcome.complete ? kExitNo : kExitIncomplete;
  }
  std::printf(outcome.complete ? "identical: every state hash of %llu ticks agrees"
                               : "incomplete: the recording is truncated; every state hash of the "
                                 "%llu ticks that it has agrees",
              static_cast<unsigned long long>(outcome.ticks));
  if (outcome.first_tick > 1)
    std::printf(" (from %.3f s)", static_cast<double>(outcome.first_tick - 1) * 1e-3);
  std::printf("\n");
  if (!outcome.complete && !options.allow_incomplete) return kExitIncomplete;
  return options.expect.empty() ? kExitDone : print_deviations(outcome.report, options.expect);
}

// A run of one hand has the report that it always had.
Result<void> save_reports(const ReplayOutcome& outcome, std::span<const TorqueReport> torques,
                          const RecordingHeader& header, const std::string& file) {
  if (file.empty()) return {};
  if (outcome.reports.size() == 1)
    return write_file_atomic(file, with_torque(to_json(outcome.report), torques, {}));
  const std::vector<std::string> names = hand_names(header);
  return write_file_atomic(file, with_torque(to_json(outcome.reports, names), torques, names));
}

void print_reports(const ReplayOutcome& outcome, std::span<const TorqueReport> torques,
                   const RecordingHeader& header) {
  const std::vector<std::string> names = hand_names(header);
  for (std::size_t h = 0; h < outcome.reports.size(); ++h) {
    if (outcome.reports.size() > 1) std::printf("hand           %s\n", names[h].c_str());
    if (h < torques.size()) std::fputs(to_text(torques[h]).c_str(), stdout);
    std::fputs(to_text(outcome.reports[h]).c_str(), stdout);
  }
}

Result<TorqueWatch> torque_of(const RecordingHeader& header, const Case& the_case,
                              const Tray& tray) {
  const auto settings = parse_settings(header.settings_json);
  if (!settings) return tl::unexpected(settings.error());
  auto portals = open_portals(the_case, *settings);
  if (!portals) return tl::unexpected(portals.error());
  return TorqueWatch(tray, std::move(*portals), header.hands);
}

// Again and again, for the times alone; what differs from the recording is judged in the last run.
Result<void> repeat_for_times(const ReplayArguments& options,
                              const std::shared_ptr<const Case>& the_case, ReplayOptions how,
                              TickWork& work) {
  how.on_tick = {};
  for (int run = 1; run < options.runs; ++run) {
    work.begin_run();
    auto recording = RecordingReader::open(options.file);
    if (!recording) return tl::unexpected(recording.error());
    const auto outcome = replay(*recording, the_case, how);
    if (!outcome) return tl::unexpected(outcome.error());
  }
  work.begin_run();
  return {};
}

int replay_recording(const ReplayArguments& options) {
  auto recording = RecordingReader::open(options.file);
  if (!recording) return report_error(recording.error());
  const auto spec = recorded_case_spec(options.file, options.case_spec, recording->header());
  if (!spec) return report_error(spec.error());
  auto the_case = open_and_show_progress(*spec, parts_of(recording->header()));
  if (!the_case) return report_error(the_case.error());
  auto frames = frames_for(options, **the_case);
  if (!frames) return report_error(frames.error());
  ReplayOptions how;
  how.from_s = options.from_s;
  if (auto ready = take_instruments(recording->header(), **the_case, how); !ready)
    return report_error(ready.error());
  auto torque = torque_of(recording->header(), **the_case, how.tray);
  if (!torque) return report_error(torque.error());
  how.on_tick = [&](std::size_t hand, const ToolState& tool, const BoneSnapshot& bones,
                    std::span<const Event>) {
    torque->see(hand, tool);
    if (*frames && hand == 0) (*frames)->add(tool, bones);
  };
  TickWork work;
  if (options.runs > 1) {
    how.on_tick_time = [&](std::size_t hand, std::int64_t ns) { work.see(hand, ns); };
    if (auto done = repeat_for_times(options, *the_case, how, work); !done)
      return report_error(done.error());
  }
  const auto outcome = replay(*recording, *the_case, how);
  if (!outcome) return report_error(outcome.error());
  if (*frames && (*frames)->failure()) return report_error(*(*frames)->failure());
  const std::vector<TorqueReport> torques =
      torque->has_levers() ? torque->finish() : std::vector<TorqueReport>();
  if (auto ok = save_reports(*outcome, torques, recording->header(), options.report); !ok)
    return report_error(ok.error());
  print_reports(*outcome, torques, recording->header());
  if (options.runs > 1) std::fputs(to_text(work, hand_names(recording->header())).c_str(), stdout);
  return judge(options, *outcome);
}

int replay_path(const ReplayArguments& options) {
  auto path = load_path(options.file);
  if (!path) return report_error(path.error());
  auto the_case =
      open_and_show_progress(options.case_spec.empty() ? "builtin:wrist" : options.case_spec,
                             options.session.soft.empty() ? CaseParts::kFelt : CaseParts::kAll);
  if (!the_case) return report_error(the_case.error());
  HeadlessRun run;
  run.the_case = *the_case;
  run.path = std::move(*path);
  auto settings = options.session.resolved();
  if (!settings) return report_error(settings.error());
  run.settings = std::move(*settings);
  run.hand = options.session.hand;
  std::unique_ptr<FrameWriter> frames;
  if (!options.frames.empty()) {
    auto made = FrameWriter::create(**the_case, options.frames);
    if (!made) return report_error(made.error());
    frames = std::make_unique<FrameWriter>(std::move(*made));
    run.on_tick = [&](const ToolState& tool, const BoneSnapshot& bones) {
      frames->add(tool, bones);
    };
  }
  const auto report = simulate(run);
  if (!report) return report_error(report.error());
  if (frames && frames->failure()) return report_error(*frames->failure());
  if (auto ok = save_report(*report, options.report); !ok) return report_error(ok.error());
  std::fputs(to_text(*report).c_str(), stdout);
  return options.expect.empty() ? kExitDone : print_deviations(*report, options.expect);
}

int run_replay(const ReplayArguments& options) {
  // A file that is missing is said before the run, not after it.
  if (!options.expect.empty())
    if (const auto expectation = read_file(options.expect, kLargestExpectation); !expectation)
      return report_error(expectation.error());
  const bool is_path = fs::path(options.file).extension() == ".csv";
  if (is_path && options.runs > 1)
    return report_error({"only a recording can be replayed several times", options.file,
                         "Leave --runs out, or record the path first"});
  return is_path ? replay_path(options) : replay_recording(options);
}

}  // namespace

void add_replay_command(cli::App& app, int& exit_code) {
  auto options = std::make_shared<ReplayArguments>();
  cli::App* command = app.add_subcommand(
      "replay",
      "Replay a recording (.osr) bit by bit, or run a probe path (.csv) and check its contacts and "
      "forces.\n"
      "Exit code: 0 identical and as expected, 1 not, 2 a bad file, 3 a truncated recording");
  command->add_option("file", options->file, "recording or probe path")->required();
  command->add_option("--case", options->case_spec,
                      "a case folder, builtin:wrist or builtin:knee; default: the recording's own; "
                      "for a path builtin:wrist");
  command->add_option("--expect", options->expect, "expected contacts and forces, JSON");
  command->add_option("--report", options->report, "write the report as JSON");
  command->add_option("--frames", options->frames, "write a picture every 1/30 s into this folder");
  command
      ->add_option("--from", options->from_s,
                   "begin at the last state stored at or before this time, s")
      ->check(cli::Range(0.0, 4 * 3600.0));
  command
      ->add_option("--runs", options->runs,
                   "replay a recording so many times and print each hand's work of a tick, the "
                   "fastest run of each tick counting: without most of what other programs took")
      ->check(cli::Range(1, 50))
      ->capture_default_str();
  command->add_flag("--allow-incomplete", options->allow_incomplete,
                    "exit with 0 for a truncated recording too, when the saved part is identical");
  options->session.add_to(*command);
  command->callback([options, &exit_code] { exit_code = run_replay(*options); });
}

}  // namespace osteon
