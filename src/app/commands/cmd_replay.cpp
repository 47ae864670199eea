#include <CLI/CLI.hpp>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>

#include "cases/open_case.h"
#include "commands/cli_support.h"
#include "commands/commands.h"
#include "commands/frames.h"
#include "commands/headless.h"
#include "commands/session_options.h"
#include "osteon/base/file.h"

namespace osteon {
namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t kLargestExpectation = 16 << 20;  // bytes

struct ReplayOptions {
  std::string file;
  std::string case_spec;
  std::string expect;
  std::string report;
  std::string frames;
  SessionOptions session;
};

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

int replay_recording(const ReplayOptions& options) {
  auto recording = load_recording(options.file);
  if (!recording) return report_error(recording.error());
  const std::string spec =
      options.case_spec.empty() ? recording->header.case_source : options.case_spec;
  auto the_case = open_and_show_progress(spec, CaseParts::kFelt);
  if (!the_case) return report_error(the_case.error());
  std::unique_ptr<FrameWriter> frames;
  if (!options.frames.empty()) {
    auto made = FrameWriter::create(**the_case, options.frames);
    if (!made) return report_error(made.error());
    frames = std::make_unique<FrameWriter>(std::move(*made));
  }
  const auto outcome =
      replay(*recording, *the_case, [&](const ToolState& tool, const BoneSnapshot& bones) {
        if (frames) frames->add(tool, bones);
      });
  if (!outcome) return report_error(outcome.error());
  if (frames && frames->failure()) return report_error(*frames->failure());
  if (auto ok = save_report(outcome->report, options.report); !ok) return report_error(ok.error());
  std::fputs(to_text(outcome->report).c_str(), stdout);
  if (!recording->complete) std::printf("the recording was cut off; replayed what was saved\n");
  if (!outcome->identical) {
    std::printf("DIFFERENT from the recording at tick %llu (%.3f s)\n",
                static_cast<unsigned long long>(outcome->first_different_tick),
                static_cast<double>(outcome->first_different_tick) * 1e-3);
    return kExitNo;
  }
  std::printf("identical: every state hash of %llu ticks agrees\n",
              static_cast<unsigned long long>(outcome->ticks));
  return options.expect.empty() ? kExitDone : print_deviations(outcome->report, options.expect);
}

int replay_path(const ReplayOptions& options) {
  auto path = load_path(options.file);
  if (!path) return report_error(path.error());
  auto the_case = open_and_show_progress(
      options.case_spec.empty() ? "builtin:wrist" : options.case_spec, CaseParts::kFelt);
  if (!the_case) return report_error(the_case.error());
  HeadlessRun run;
  run.the_case = *the_case;
  run.path = std::move(*path);
  run.settings = options.session.resolved();
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

int run_replay(const ReplayOptions& options) {
  // A file that is missing is said before the run, not after it.
  if (!options.expect.empty())
    if (const auto expectation = read_file(options.expect, kLargestExpectation); !expectation)
      return report_error(expectation.error());
  const bool is_path = fs::path(options.file).extension() == ".csv";
  return is_path ? replay_path(options) : replay_recording(options);
}

}  // namespace

void add_replay_command(CLI::App& app, int& exit_code) {
  auto options = std::make_shared<ReplayOptions>();
  CLI::App* command = app.add_subcommand(
      "replay",
      "Repeat a recording (.osr) bit by bit, or run a probe path (.csv) and check what it felt.\n"
      "Exit code: 0 identical and as expected, 1 not, 2 a bad file");
  command->add_option("file", options->file, "recording or probe path")->required();
  command->add_option("--case", options->case_spec,
                      "a case folder, builtin:wrist or builtin:knee (default: the recording's own; "
                      "for a path builtin:wrist)");
  command->add_option("--expect", options->expect, "expected contacts and forces, JSON");
  command->add_option("--report", options->report, "write the report as JSON");
  command->add_option("--frames", options->frames, "write a picture every 1/30 s into this folder");
  options->session.add_to(*command);
  command->callback([options, &exit_code] { exit_code = run_replay(*options); });
}

}  // namespace osteon
