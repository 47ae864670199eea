#include "commands/support/headless.h"

#include <algorithm>
#include <cmath>

#include "commands/sessions/hand_in_loop.h"
#include "osteon/base/clock.h"
#include "osteon/base/percentiles.h"
#include "osteon/physics/carving.h"
#include "osteon/physics/soft_setup.h"
#include "osteon/record/recording.h"
#include "osteon/scene/tool_moment.h"
#include "runs/hands/tray.h"
#include "runs/replays/path_commands.h"

namespace osteon {
namespace {

Result<std::optional<RecordingWriter>> open_recording(const HeadlessRun& run,
                                                      const SessionSettings& settings,
                                                      const Session& session) {
  if (!run.record_to) return std::optional<RecordingWriter>{};
  auto writer =
      RecordingWriter::create(*run.record_to, header_of_run(run, settings, session.tray()));
  if (!writer) return tl::unexpected(writer.error());
  return std::optional<RecordingWriter>(std::move(*writer));
}

Result<void> record(RecordingWriter& writer, const Session& session) {
  if (session.last_steps() > 0)
    if (auto ok = writer.add(session.last_step_record()); !ok) return ok;
  for (std::size_t h = 0; h < session.hands(); ++h) {
    if (auto ok = writer.add(session.last_tick_record(h), h); !ok) return ok;
    for (const Event& event : session.last_events(h))
      if (auto ok = writer.add(event); !ok) return ok;
  }
  const bool keep = session.last_steps() > 0 && session.bones().saved_step == session.bones().step;
  return keep ? writer.add(stored_state(session)) : Result<void>{};
}

void fill_timing(Report& report, const Percentiles& ticks, std::int64_t elapsed_ns) {
  set_tick_times(report, ticks);
  if (elapsed_ns > 0)
    report.realtime_factor = report.duration_s / (static_cast<double>(elapsed_ns) * 1e-9);
}

// One hand of the run while it goes on.
struct RunningHand {
  std::unique_ptr<HandInLoop> hand;
  PathCommands commands;
  ReportBuilder report;
};

Result<std::unique_ptr<HandInLoop>> take_hand(const HeadlessRun& run, const HeadlessHand& hand,
                                              HapticParams& haptic) {
  const ProbePath& path = hand.path;
  if (hand.user) return hand.user(haptic.tick_s);
  if (run.user) return run.user(haptic.tick_s);
  if (run.device.empty()) return free_hand(path, run.hand, haptic.tick_s);
  return hand_on_device(run.device, path, haptic);
}

std::vector<HeadlessHand> hands_of(const HeadlessRun& run) {
  if (!run.hands.empty()) return run.hands;
  return {HeadlessHand{"", run.path}};
}

class HeadlessLoop {
 public:
  HeadlessLoop(const HeadlessRun& run, const SessionSettings& settings, Tray tray,
               std::shared_ptr<const CarvingSetup> carving, std::shared_ptr<const SoftSetup> softs,
               std::vector<RunningHand> hands)
      : run_(run),
        session_(run.the_case, settings, std::move(tray), std::move(carving), std::move(softs)),
        hands_(std::move(hands)),
        torque_(session_.tray(), {session_.portals().begin(), session_.portals().end()},
                hands_.size()) {}

  void tick(std::uint64_t n, double dt) {
    inputs_.clear();
    for (RunningHand& hand : hands_) {
      inputs_.push_back({hand.hand->move(), hand.commands.at(static_cast<double>(n) * dt)});
      Command& command = inputs_.back().command;
      if (command.kind == CommandKind::kNone) command = hand.hand->command();
    }
    say_beside();
    if (run_.on_hands && (n == 0 || session_.last_steps() > 0)) consumed_ = session_.bones();
    const std::int64_t before = steady_now_ns();
    (void)session_.tick(inputs_);
    tick_times_.add_ns(steady_now_ns() - before);
    for (std::size_t h = 0; h < hands_.size(); ++h) {
      const ToolState& tool = session_.tool_state(h);
      if (hands_[h].hand->drives_rotation())
        hands_[h].hand->turn(moment_about(tool.X_WP.p, tool, session_.portals()));
      hands_[h].hand->feel(tool.force_W);
      hands_[h].report.add(tool);
      for (const Event& event : session_.last_events(h)) hands_[h].report.add(event);
      torque_.see(h, tool);
    }
    if (run_.on_hands) {
      tools_.clear();
      for (std::size_t h = 0; h < hands_.size(); ++h) tools_.push_back(&session_.tool_state(h));
      run_.on_hands(tools_, consumed_);
    }
    carving_.see(session_);
    softs_.see(session_);
    if (run_.on_tick) run_.on_tick(session_.tool_state(0), session_.bones());
  }
  // Between two steps the newest command for physics counts: one that a hand gives goes first.
  void say_beside() {
    const bool steps_next = session_.last_steps() == 0;
    if (!run_.beside || !steps_next) return;
    for (const HandInput& input : inputs_)
      if (is_for_physics(input.command.kind)) return;
    if (inputs_.front().command.kind != CommandKind::kNone) return;
    if (const auto said = run_.beside()) inputs_.front().command = *said;
  }
  std::string complaint() const {
    for (const RunningHand& hand : hands_)
      if (std::string why = hand.hand->complaint(); !why.empty()) return why;
    return {};
  }
  const Session& session() const { return session_; }
  std::optional<CarvingReport> carving() const { return carving_.finish(session_); }
  std::vector<TorqueReport> torques() const {
    return torque_.has_levers() ? torque_.finish() : std::vector<TorqueReport>();
  }

  std::optional<SoftReport> softs() const { return softs_.finish(session_); }

  std::vector<Report> reports(std::int64_t elapsed_ns) const {
    std::vector<Report> reports;
    for (const RunningHand& hand : hands_) {
      Report report = hand.report.finish();
      report.state_hash = session_.state_hash();
      fill_timing(report, tick_times_, elapsed_ns);
      reports.push_back(std::move(report));
    }
    return reports;
  }

 private:
  const HeadlessRun& run_;
  Session session_;
  std::vector<RunningHand> hands_;
  std::vector<HandInput> inputs_;
  std::vector<const ToolState*> tools_;
  BoneSnapshot consumed_;  ///< by the last tick: what whoever repeats the recording sees at it
  Percentiles tick_times_;
  CarvingWatch carving_;
  TorqueWatch torque_;
  SoftWatch softs_;
};

Result<HeadlessLoop> make_loop(const HeadlessRun& run, std::span<const HeadlessHand> hands,
                               SessionSettings& settings) {
  std::vector<std::unique_ptr<HandInLoop>> taken;
  for (const HeadlessHand& hand : hands) {
    auto one = take_hand(run, hand, settings.haptic);
    if (!one) return tl::unexpected(one.error());
    taken.push_back(std::move(*one));
  }
  auto parts = parts_of_run(run, hands, settings);
  if (!parts) return tl::unexpected(parts.error());
  settings = parts->settings;
  std::vector<RunningHand> running;
  for (std::size_t h = 0; h < hands.size(); ++h)
    running.push_back({std::move(taken[h]), PathCommands(hands[h].path, settings.tray),
                       ReportBuilder(*run.the_case, settings.haptic.tick_s, parts->portals)});
  return HeadlessLoop(run, settings, std::move(parts->tray), std::move(parts->carving),
                      std::move(parts->softs), std::move(running));
}

RunSight sight_of(const Session& session) {
  RunSight sight;
  sight.bones = [&session] { return &session.bones(); };
  sight.carved = [&session](std::uint32_t bone) {
    const Carving* carving = session.carving();
    const CarvedField* field = carving ? carving->field(bone) : nullptr;
    return field && field->block_count() > 0 ? std::optional<CarvedField>(*field) : std::nullopt;
  };
  return sight;
}

}  // namespace

// The tray holds what the paths name, and the wrist probe where a path begins with none.
std::vector<std::string> tray_of_hands(std::span<const HeadlessHand> hands) {
  std::vector<std::string> names;
  for (const HeadlessHand& hand : hands)
    for (const std::string& name : instruments_of(hand.path))
      if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
  return names.size() == 1 && names[0] == kWristProbe ? std::vector<std::string>() : names;
}

RecordingHeader header_of_run(const HeadlessRun& run, const SessionSettings& settings,
                              const Tray& tray) {
  RecordingHeader header =
      recording_header(*run.the_case, settings, run.case_source, OSTEON_VERSION, tray);
  header.case_path = absolute_case_path(run.case_source);
  return header;
}

Result<RunParts> parts_of_run(const HeadlessRun& run, std::span<const HeadlessHand> hands,
                              SessionSettings settings) {
  RunParts parts;
  settings.tray = tray_of_hands(hands);
  auto tray = make_tray(settings.tray, settings.probe_radius_m);
  if (!tray) return tl::unexpected(tray.error());
  parts.tray = std::move(*tray);
  auto portals = open_portals(*run.the_case, settings);
  if (!portals) return tl::unexpected(portals.error());
  parts.portals = std::move(*portals);
  settings.hands.clear();
  for (const HeadlessHand& hand : hands)
    settings.hands.push_back(
        {hand.name, PathCommands(hand.path, settings.tray).first_instrument()});
  settings.carve.on = can_carve(*run.the_case, settings.tray);
  settings.soft_structures = !run.the_case->softs.empty();
  if (auto sound = check_settings(settings); !sound) return tl::unexpected(sound.error());
  auto carving = carving_for(*run.the_case, settings);
  if (!carving) return tl::unexpected(carving.error());
  parts.carving = std::move(*carving);
  auto softs = softs_for(*run.the_case, settings);
  if (!softs) return tl::unexpected(softs.error());
  if (*softs) settings.soft_hash = (*softs)->hash;
  parts.softs = std::move(*softs);
  parts.settings = std::move(settings);
  return parts;
}

Result<HeadlessOutcome> simulate_hands(const HeadlessRun& run) {
  const std::vector<HeadlessHand> hands = hands_of(run);
  SessionSettings settings = run.settings;
  auto loop = make_loop(run, hands, settings);
  if (!loop) return tl::unexpected(loop.error());
  auto writer = open_recording(run, settings, loop->session());
  if (!writer) return tl::unexpected(writer.error());
  if (run.on_begin) run.on_begin(sight_of(loop->session()));
  double duration_s = 0;
  for (const HeadlessHand& hand : hands) duration_s = std::max(duration_s, hand.path.duration_s());
  const double dt = run.settings.haptic.tick_s;
  const bool by_users =
      run.user || std::any_of(run.hands.begin(), run.hands.end(),
                              [](const HeadlessHand& hand) { return bool(hand.user); });
  if (by_users) duration_s = run.longest_s;
  const auto ticks = static_cast<std::uint64_t>(std::ceil(duration_s / dt));
  const std::int64_t started = steady_now_ns();
  for (std::uint64_t n = 0; n < ticks; ++n) {
    loop->tick(n, dt);
    if (*writer)
      if (auto ok = record(**writer, loop->session()); !ok) return tl::unexpected(ok.error());
    if (by_users && run.done && run.done()) break;
    if (run.ends_when_over && run.over && run.over()) break;
  }
  if (*writer)
    if (auto ok = (*writer)->finish(); !ok) return tl::unexpected(ok.error());
  if (const std::string why = loop->complaint(); !why.empty())
    return fail(why, run.device,
                "If you asked for a recording, it contains the run up to this moment");
  HeadlessOutcome outcome;
  for (const HeadlessHand& hand : hands) outcome.names.push_back(hand.name);
  outcome.reports = loop->reports(steady_now_ns() - started);
  outcome.carving = loop->carving();
  outcome.torques = loop->torques();
  outcome.softs = loop->softs();
  return outcome;
}

Result<Report> simulate(const HeadlessRun& run) {
  auto outcome = simulate_hands(run);
  if (!outcome) return tl::unexpected(outcome.error());
  return std::move(outcome->reports.front());
}

}  // namespace osteon
