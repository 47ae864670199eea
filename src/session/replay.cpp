#include <bit>
#include <deque>

#include "osteon/base/clock.h"
#include "osteon/base/percentiles.h"
#include "osteon/session/session.h"

namespace osteon {
namespace {

bool same_bits(const Vec3& a, const Vec3& b) {
  for (int i = 0; i < 3; ++i)
    if (std::bit_cast<std::uint64_t>(a[i]) != std::bit_cast<std::uint64_t>(b[i])) return false;
  return true;
}

bool same_result(const TickRecord& a, const TickRecord& b) {
  return same_bits(a.force_W, b.force_W) && same_bits(a.p_WP, b.p_WP) && a.status == b.status &&
         a.state_hash == b.state_hash;
}

// Runs each physics step just before the first tick that consumed it. The tool states that steps
// still to come will consume are kept until then.
class Replayer {
 public:
  Replayer(const Recording& recording, std::shared_ptr<const Case> the_case,
           const SessionSettings& settings)
      : recording_(recording), session_(std::move(the_case), settings) {}

  const ToolState& tick(const TickRecord& record) {
    run_steps_to(record.bone_step);
    const std::int64_t begin_ns = steady_now_ns();
    const ToolState& tool = session_.haptic_tick(record.input, session_.bones(), record.command);
    last_tick_ns_ = steady_now_ns() - begin_ns;
    elapsed_ns_ += last_tick_ns_;
    keep(tool);
    return tool;
  }

  void run_steps_to(std::uint64_t step) {
    const std::int64_t begin_ns = steady_now_ns();
    while (session_.bones().step < step) run_next_step();
    elapsed_ns_ += steady_now_ns() - begin_ns;
  }

  // Far more than any pair of threads drifts apart, and little memory.
  bool runs_apart() const { return kept_.size() > 20000; }
  const Session& session() const { return session_; }
  std::int64_t last_tick_ns() const { return last_tick_ns_; }
  std::int64_t elapsed_ns() const { return elapsed_ns_; }

 private:
  void run_next_step() {
    const StepRecord& record = recording_.steps[session_.bones().step];
    while (!kept_.empty() && kept_.front().tick < record.tool_tick) kept_.pop_front();
    (void)session_.physics_step(record.tool_tick == 0 ? before_first_ : kept_.front(),
                                record.command);
  }

  // Steps consume ticks in order, so one look ahead tells whether this one will be wanted.
  void keep(const ToolState& tool) {
    const auto& steps = recording_.steps;
    while (ahead_ < steps.size() && steps[ahead_].tool_tick < tool.tick) ++ahead_;
    if (ahead_ < steps.size() && steps[ahead_].tool_tick == tool.tick) kept_.push_back(tool);
  }

  const Recording& recording_;
  Session session_;
  const ToolState before_first_{};
  std::deque<ToolState> kept_;
  std::size_t ahead_ = 0;
  std::int64_t last_tick_ns_ = 0;
  std::int64_t elapsed_ns_ = 0;
};

Result<SessionSettings> settings_of(const Recording& recording, const Case& the_case) {
  const RecordingHeader& header = recording.header;
  if (header.case_hash != the_case.hash)
    return fail("the recording was made with another case ('" + header.case_name + "' from '" +
                    header.case_source + "') than '" + the_case.name +
                    "', or that case has changed",
                "recording", "Give the case that it was made with");
  auto settings = parse_settings(header.settings_json);
  if (settings && settings->seed != header.seed)
    return fail("the header and the settings name different seeds", "recording",
                "The file is damaged: use another copy of it");
  return settings;
}

// The part of the report that the ticks alone do not tell.
void complete(Report& report, const Replayer& replayer, const Percentiles& durations,
              std::uint64_t missed_ticks) {
  set_tick_times(report, durations);
  report.missed_ticks = missed_ticks;
  report.state_hash = replayer.session().state_hash();
  const double elapsed_s = static_cast<double>(replayer.elapsed_ns()) * 1e-9;
  report.realtime_factor = elapsed_s > 0 ? report.duration_s / elapsed_s : 0;
}

}  // namespace

Result<ReplayOutcome> replay(
    const Recording& recording, std::shared_ptr<const Case> the_case,
    const std::function<void(const ToolState&, const BoneSnapshot&)>& on_tick) {
  const auto settings = settings_of(recording, *the_case);
  if (!settings) return tl::unexpected(settings.error());
  if (const auto sound = check_consumption(recording); !sound) return tl::unexpected(sound.error());

  Replayer replayer(recording, the_case, *settings);
  ReportBuilder builder(*the_case, settings->haptic.tick_s);
  Percentiles durations;
  ReplayOutcome outcome;
  std::uint64_t missed_ticks = 0;
  const double tick_ns = settings->haptic.tick_s * 1e9;
  for (const TickRecord& record : recording.ticks) {
    const ToolState& tool = replayer.tick(record);
    if (outcome.identical && !same_result(replayer.session().last_tick_record(), record)) {
      outcome.identical = false;
      outcome.first_different_tick = record.tick;
    }
    builder.add(tool);
    durations.add_ns(replayer.last_tick_ns());
    if (static_cast<double>(replayer.last_tick_ns()) > tick_ns) ++missed_ticks;
    if (on_tick) on_tick(tool, replayer.session().bones());
    if (replayer.runs_apart())
      return fail("the two clocks of the recording run too far apart", "recording",
                  "The file is damaged: use another copy of it");
  }
  replayer.run_steps_to(recording.steps.size());
  outcome.ticks = recording.ticks.size();
  outcome.report = builder.finish();
  complete(outcome.report, replayer, durations, missed_ticks);
  return outcome;
}

}  // namespace osteon
