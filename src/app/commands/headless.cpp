#include "commands/headless.h"

#include <cmath>

#include "commands/hand_in_loop.h"
#include "osteon/base/clock.h"
#include "osteon/base/percentiles.h"
#include "osteon/record/recording.h"

namespace osteon {
namespace {

Result<std::optional<RecordingWriter>> open_recording(const HeadlessRun& run,
                                                      const SessionSettings& settings) {
  if (!run.record_to) return std::optional<RecordingWriter>{};
  RecordingHeader header;
  header.case_name = run.the_case->name;
  header.case_source = run.case_source;
  header.case_hash = run.the_case->hash;
  header.seed = settings.seed;
  header.settings_json = to_json(settings);
  header.osteon_version = OSTEON_VERSION;
  auto writer = RecordingWriter::create(*run.record_to, header);
  if (!writer) return tl::unexpected(writer.error());
  return std::optional<RecordingWriter>(std::move(*writer));
}

Result<void> record(RecordingWriter& writer, const Session& session) {
  if (session.last_steps() > 0)
    if (auto ok = writer.add(session.last_step_record()); !ok) return ok;
  return writer.add(session.last_tick_record());
}

void fill_timing(Report& report, const Percentiles& ticks, std::int64_t elapsed_ns) {
  set_tick_times(report, ticks);
  if (elapsed_ns > 0)
    report.realtime_factor = report.duration_s / (static_cast<double>(elapsed_ns) * 1e-9);
}

Result<std::unique_ptr<HandInLoop>> take_hand(const HeadlessRun& run, HapticParams& haptic) {
  if (run.user) return run.user(haptic.tick_s);
  if (run.device.empty()) return free_hand(run.path, run.hand, haptic.tick_s);
  return hand_on_device(run.device, run.path, haptic);
}

}  // namespace

Result<Report> simulate(const HeadlessRun& run) {
  SessionSettings settings = run.settings;
  auto hand = take_hand(run, settings.haptic);
  if (!hand) return tl::unexpected(hand.error());
  auto writer = open_recording(run, settings);
  if (!writer) return tl::unexpected(writer.error());
  Session session(run.the_case, settings);
  ReportBuilder builder(*run.the_case, run.settings.haptic.tick_s);
  Percentiles tick_times;
  const double dt = run.settings.haptic.tick_s;
  const auto ticks = static_cast<std::uint64_t>(
      std::ceil((run.user ? run.longest_s : run.path.duration_s()) / dt));
  const std::int64_t started = steady_now_ns();
  for (std::uint64_t n = 0; n < ticks; ++n) {
    const ToolInput input = (*hand)->move();
    const std::int64_t before = steady_now_ns();
    const ToolState& tool = session.tick(input);
    tick_times.add_ns(steady_now_ns() - before);
    (*hand)->feel(tool.force_W);
    builder.add(tool);
    if (*writer)
      if (auto ok = record(**writer, session); !ok) return tl::unexpected(ok.error());
    if (run.on_tick) run.on_tick(tool, session.bones());
    if (run.user && run.done && run.done()) break;
  }
  if (*writer)
    if (auto ok = (*writer)->finish(); !ok) return tl::unexpected(ok.error());
  if (const std::string why = (*hand)->complaint(); !why.empty())
    return fail(why, run.device, "The run up to there is in the recording, if you asked for one");
  const std::int64_t elapsed = steady_now_ns() - started;
  Report report = builder.finish();
  report.state_hash = session.state_hash();
  fill_timing(report, tick_times, elapsed);
  return report;
}

}  // namespace osteon
