#include <algorithm>
#include <bit>

#include "osteon/base/percentiles.h"
#include "osteon/physics/soft_world.h"
#include "osteon/scene/tool_hash.h"
#include "osteon/session/session.h"
#include "replayer.h"
#include "whole_tray.h"

namespace osteon {
namespace {

constexpr const char* kDamaged = "The file is damaged: use another copy of it";

bool same_bits(const Vec3& a, const Vec3& b) {
  for (int i = 0; i < 3; ++i)
    if (std::bit_cast<std::uint64_t>(a[i]) != std::bit_cast<std::uint64_t>(b[i])) return false;
  return true;
}

bool same_result(const TickRecord& a, const TickRecord& b) {
  return same_bits(a.force_W, b.force_W) && same_bits(a.p_WP, b.p_WP) && a.status == b.status &&
         a.state_hash == b.state_hash;
}

// An instrument or a portal that is not what it was would be felt in another way.
Result<void> check_world(const RecordingHeader& header, const Case& the_case,
                         const SessionSettings& settings, const Tray& tray) {
  const std::size_t instruments = std::max<std::size_t>(1, settings.tray.size());
  if (!settings.tray.empty() && tray.size() != instruments)
    return fail("the recording's hands hold " + std::to_string(instruments) + " instruments, but " +
                    std::to_string(tray.size()) + " were given",
                "recording", "Give the tray that its settings name");
  if (header.tray_hash != 0 && header.tray_hash != felt_hash(whole_tray(tray, settings)))
    return fail("the instruments of the recording have changed since it was made", "recording",
                "Replay it with the version of Osteon that made it: " + header.osteon_version);
  const auto portals = open_portals(the_case, settings);
  if (!portals) return tl::unexpected(portals.error());
  if (header.portals_hash != 0 && header.portals_hash != hash_of(*portals))
    return fail("the portals of the case or their skin have changed since the recording was made",
                "recording", "Give the case that it was made with");
  return {};
}

Result<SessionSettings> settings_of(const RecordingHeader& header, const Case& the_case,
                                    const Tray& tray) {
  if (header.case_hash != the_case.hash)
    return fail("the recording was made with another case ('" + header.case_name + "' from '" +
                    header.case_source + "') than '" + the_case.name +
                    "', or that case has changed",
                "recording", "Give the case that it was made with");
  auto settings = parse_settings(header.settings_json);
  if (settings && settings->seed != header.seed)
    return fail("the header and the settings name different seeds", "recording", kDamaged);
  if (settings && settings->hands.size() != header.hands)
    return fail("the header and the settings have different hands", "recording", kDamaged);
  if (settings)
    if (auto same = check_world(header, the_case, *settings, tray); !same)
      return tl::unexpected(same.error());
  return settings;
}

// What the ticks of each hand add up to.
class Tally {
 public:
  Tally(const Session& session, double tick_s, std::uint64_t reported_after)
      : tick_ns_(tick_s * 1e9), reported_after_(reported_after) {
    for (std::size_t h = 0; h < session.hands(); ++h)
      hands_.push_back({ReportBuilder(session.the_case(), tick_s, session.portals())});
  }

  void add(const Replayer& replayer, ReplayOutcome& outcome) {
    Hand& hand = hands_[replayer.hand()];
    const TickRecord& record = replayer.record();
    const Session& session = replayer.session();
    if (outcome.identical && !same_result(session.last_tick_record(replayer.hand()), record)) {
      outcome.identical = false;
      outcome.first_different_hand = replayer.hand();
      outcome.first_different_tick = record.tick;
    }
    if (record.tick > reported_after_) {
      hand.report.add(session.tool_state(replayer.hand()));
      for (const Event& event : session.last_events(replayer.hand())) hand.report.add(event);
    }
    hand.durations.add_ns(replayer.last_tick_ns());
    if (static_cast<double>(replayer.last_tick_ns()) > tick_ns_) ++hand.missed_ticks;
    if (++hand.ticks == 1 && replayer.hand() == 0) outcome.first_tick = record.tick;
  }

  void finish(const Replayer& replayer, ReplayOutcome& outcome) {
    outcome.state_hash = replayer.session().state_hash();
    const double elapsed_s = static_cast<double>(replayer.elapsed_ns()) * 1e-9;
    for (Hand& hand : hands_) {
      Report report = hand.report.finish();
      set_tick_times(report, hand.durations);
      set_step_times(report, replayer.step_times());
      report.missed_ticks = hand.missed_ticks;
      report.state_hash = outcome.state_hash;
      report.realtime_factor = elapsed_s > 0 ? report.duration_s / elapsed_s : 0;
      outcome.ticks = std::max(outcome.ticks, hand.ticks);
      outcome.reports.push_back(std::move(report));
    }
    outcome.report = outcome.reports.front();
  }

 private:
  struct Hand {
    ReportBuilder report;
    Percentiles durations{};
    std::uint64_t ticks = 0, missed_ticks = 0;
  };
  std::vector<Hand> hands_;
  double tick_ns_;
  std::uint64_t reported_after_;
};

// A session and who repeats the recording in it.
struct Repeated {
  Session session;
  Replayer replayer;
  Repeated(const RecordSource& source, Session begun)
      : session(std::move(begun)), replayer(source, session) {}
};

// The last stored state from which a replay can begin, or the start.
Result<void> begin(const RecordSource& source, double from_s, double tick_s,
                   std::unique_ptr<Repeated>& repeated,
                   const std::function<std::unique_ptr<Repeated>()>& make) {
  repeated = make();
  if (!(from_s > 0)) return {};
  auto states = source.states();
  if (!states) return tl::unexpected(states.error());
  const double last = from_s / tick_s + 1e-6;
  for (std::size_t i = states->size(); i-- > 0;) {
    const StoredState& state = (*states)[i];
    if (static_cast<double>(state.ticks[0]) > last) continue;
    const auto begun = repeated->replayer.begin_at(state);
    if (!begun) return tl::unexpected(begun.error());
    if (*begun) return {};
    repeated = make();
  }
  return {};
}

Result<ReplayOutcome> replay_source(const RecordSource& source,
                                    const std::shared_ptr<const Case>& the_case,
                                    const ReplayOptions& options) {
  const auto settings = settings_of(*source.header, *the_case, options.tray);
  if (!settings) return tl::unexpected(settings.error());
  if (settings->carve.on && !options.carving)
    return fail("the recording removes bone, which this kind of replay cannot do", "recording",
                "Use 'osteon replay' or 'osteon case save'");
  if (settings->soft.empty() == static_cast<bool>(options.softs))
    return fail("soft parts are felt in the recording, which this kind of replay cannot do",
                "recording", "Use 'osteon replay'");
  std::unique_ptr<Repeated> repeated;
  const auto begun = begin(source, options.from_s, settings->haptic.tick_s, repeated, [&] {
    return std::make_unique<Repeated>(
        source, Session(the_case, *settings, options.tray, options.carving, options.softs));
  });
  if (!begun) return tl::unexpected(begun.error());
  Replayer* const replayer = &repeated->replayer;
  if (options.at_begin) options.at_begin(replayer->session());
  Tally tally(replayer->session(), settings->haptic.tick_s, options.reported_after);
  ReplayOutcome outcome;
  Replayer::Outcome last = Replayer::Outcome::kEnd;
  const double to_tick = options.to_s / settings->haptic.tick_s + 1e-6;
  const auto wanted = [&] {
    const std::uint64_t done = replayer->session().tool_state().tick;
    return !(options.to_s > 0) || static_cast<double>(done) + 1 <= to_tick;
  };
  CutsPatch patch;
  const auto show_cuts = [&] {
    CutsFeed* feed = options.on_cuts ? replayer->cuts_feed() : nullptr;
    while (feed && feed->take(patch)) options.on_cuts(patch, replayer->bones_time_s());
  };
  while (wanted() && (last = replayer->next()) == Replayer::Outcome::kTick) {
    show_cuts();
    tally.add(*replayer, outcome);
    const std::size_t hand = replayer->hand();
    if (options.on_tick_time) options.on_tick_time(hand, replayer->last_tick_ns());
    if (options.on_pushes && replayer->session().softs())
      options.on_pushes(replayer->session().softs()->pushes());
    if (options.on_tick)
      options.on_tick(hand, replayer->session().tool_state(hand), replayer->bones(),
                      replayer->session().last_events(hand));
  }
  show_cuts();
  if (options.at_end) options.at_end(replayer->session());
  if (last == Replayer::Outcome::kError) return tl::unexpected(replayer->error());
  if (last == Replayer::Outcome::kStuck && source.complete)
    return fail("a tick or step used data that is not in the recording", "recording", kDamaged);
  tally.finish(*replayer, outcome);
  outcome.complete = source.complete;
  return outcome;
}

}  // namespace

Result<void> repeat(RecordingReader& recording, Session& session, const RepeatOptions& options) {
  if (recording.header().case_hash != session.the_case().hash ||
      recording.header().hands != session.hands())
    return fail("the recording is of another patient or of other hands", "recording",
                "Record it again");
  const RecordSource source = source_of(recording);
  Replayer replayer(source, session);
  replayer.tell_steps(options.on_step);
  replayer.change_commands(options.change);
  for (;;) {
    const Replayer::Outcome last = replayer.next();
    if (last == Replayer::Outcome::kError) return tl::unexpected(replayer.error());
    if (last != Replayer::Outcome::kTick) return {};
    if (!options.on_tick(replayer.hand(), replayer.bones())) return {};
  }
}

Result<ReplayOutcome> replay(const Recording& recording, std::shared_ptr<const Case> the_case,
                             const ReplayOptions& options) {
  const auto settings = settings_of(recording.header, *the_case, options.tray);
  if (!settings) return tl::unexpected(settings.error());
  if (const auto sound = check_consumption(recording); !sound) return tl::unexpected(sound.error());
  return replay_source(source_of(recording), the_case, options);
}

Result<ReplayOutcome> replay(RecordingReader& recording, std::shared_ptr<const Case> the_case,
                             const ReplayOptions& options) {
  return replay_source(source_of(recording), the_case, options);
}

Result<ReplayOutcome> replay(
    const Recording& recording, std::shared_ptr<const Case> the_case,
    const std::function<void(const ToolState&, const BoneSnapshot&)>& on_tick) {
  ReplayOptions options;
  if (on_tick)
    options.on_tick = [&](std::size_t hand, const ToolState& tool, const BoneSnapshot& bones,
                          std::span<const Event>) {
      if (hand == 0) on_tick(tool, bones);
    };
  return replay(recording, std::move(the_case), options);
}

}  // namespace osteon
