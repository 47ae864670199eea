#include "window/controllers/sessions/ghost_control.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "exercises/result_files.h"
#include "runs/hands/tray.h"

namespace osteon {
namespace {

constexpr double kFullOpacity = 0.55;
constexpr double kFaint = 0.02;  // less is not seen

const std::string& name_in(const std::vector<std::string>& tray, std::uint32_t at) {
  return tray.empty() ? kWristProbe : tray[at < tray.size() ? at : 0];
}

}  // namespace

GhostControl::GhostControl(WindowHost& host, SceneSight& sight, LiveControl& live)
    : host_(host),
      sight_(sight),
      live_(live),
      on_(host.order.ghost != "off"),
      guides_(host.order.guide) {}

void GhostControl::begin(GhostWanted wanted) {
  end();
  const bool same = wanted.scenario.source_text == wanted_.scenario.source_text &&
                    wanted.case_spec == wanted_.case_spec &&
                    wanted.case_hash == wanted_.case_hash &&
                    wanted.graft_json == wanted_.graft_json && wanted.to_stage == wanted_.to_stage;
  if (!same) track_.reset();
  wanted_ = std::move(wanted);
  allowed_ = wanted_.scenario.ghost;
  follower_ = {};
  left_.clear();
  problem_.clear();
  if (on_ || guides_) prepare();
}

// What is known of the same exercise on the same patient is not made again, but the learner's
// results may be new.
void GhostControl::prepare() {
  if (!allowed_ || job_) return;
  const std::string& order = host_.order.ghost;
  const std::string recording = order == "off" ? std::string() : order;
  early_ = std::make_shared<Early>();
  job_ = std::make_unique<SideJob<Prepared>>(
      [wanted = wanted_, recording, track = track_, early = early_,
       ordered = host_.order.ghost_strength](const Progress& progress) -> Result<Prepared> {
        Prepared prepared{track, 1};
        prepared.strength =
            ordered ? *ordered : ghost_strength_of(learner_here(), wanted.scenario.name);
        if (prepared.track || kFullOpacity * prepared.strength < kFaint) return prepared;
        const auto go_on = [&progress] { return progress(nullptr, 0); };
        const auto see = [&](GhostTrack part) {
          auto known = std::make_shared<const GhostTrack>(std::move(part));
          const std::scoped_lock lock(early->mutex);
          early->newest = {std::move(known), prepared.strength};
        };
        auto made = recording.empty() ? ghost_of_expert(wanted, go_on, {}, see)
                                      : ghost_of_recording(recording, wanted, see);
        if (!made) return tl::unexpected(made.error());
        prepared.track = std::make_shared<const GhostTrack>(std::move(*made));
        return prepared;
      });
}

void GhostControl::toggle() {
  on_ = !on_;
  if (on_ && !track_ && problem_.empty()) prepare();
}

void GhostControl::toggle_guide() {
  guides_ = !guides_;
  if (guides_ && !track_ && problem_.empty()) prepare();
}

void GhostControl::end() {
  if (job_) track_.reset();  // it may end in the middle
  job_.reset();
  allowed_ = false;
  sight_.set_ghosts({});
  lead_nobody();
}

void GhostControl::lead_nobody() {
  for (std::size_t h = 0; live_.run() && h < live_.run()->hands(); ++h) live_.run()->guide(h, {});
}

// A long exercise takes minutes to repeat; its first steps are known long before.
void GhostControl::take_early() {
  const std::scoped_lock lock(early_->mutex);
  if (!early_->newest) return;
  track_ = early_->newest->track;
  strength_ = early_->newest->strength;
  early_->newest.reset();
}

void GhostControl::take_prepared() {
  if (!job_) return;
  take_early();
  if (!job_->done()) return;
  auto prepared = job_->take();
  job_.reset();
  if (!prepared) {
    track_.reset();
    problem_ = "The expert is not shown: " + prepared.error().what;
    host_.note(ToastKind::kWarning, "The expert is not shown: " + prepared.error().message());
    return;
  }
  track_ = prepared->track;
  strength_ = prepared->strength;
}

// The run's tray may have the same instruments in another order, or not all of them.
std::optional<std::uint32_t> GhostControl::in_tray(std::uint32_t instrument) const {
  return live_.tray().find(name_in(track_->tray, instrument));
}

std::optional<Pose> GhostControl::beside_active_hand() const {
  if (!live_.run() || !track_ || !allowed_ || !on_) return std::nullopt;
  for (const std::size_t stretch : left_)
    if (const auto held = beside_in(stretch)) return held;
  return std::nullopt;
}

std::optional<Pose> GhostControl::beside_in(std::size_t stretch) const {
  const LiveRun& run = *live_.run();
  const ToolState& tool = run.hand(run.active()).snapshot.tool;
  std::optional<Pose> held;
  for (std::uint32_t i = 0; !held && i < std::max<std::size_t>(track_->tray.size(), 1); ++i)
    if (in_tray(i) == tool.instrument)
      held = ghost_beside(*track_, stretch, run.active(), i, tool.X_WP.p);
  // Which size is right is what a learner finds out; all of them are held alike.
  return held ? held
              : ghost_beside_in_any_size(*track_, stretch, run.active(),
                                         name_in(live_.tray().run().names, tool.instrument),
                                         tool.X_WP.p);
}

// In whatever size.
bool GhostControl::is_held_alike(std::uint32_t ghosts, std::uint32_t held) const {
  if (in_tray(ghosts) == held) return true;
  const auto his = parse_tool_name(name_in(track_->tray, ghosts));
  const auto mine = parse_tool_name(name_in(live_.tray().run().names, held));
  return his && mine && his->name == mine->name;
}

std::optional<GhostControl::Onward> GhostControl::onward_with_active_hand() {
  const LiveRun* const run = live_.run();
  if (!run || !track_ || !allowed_ || !on_) return std::nullopt;
  const std::size_t hand = run->active();
  const ToolState& tool = run->hand(hand).snapshot.tool;
  const auto holds = [&](std::uint32_t ghosts) { return is_held_alike(ghosts, tool.instrument); };
  for (const std::size_t stretch : left_) {
    auto at = brought_.stretch == stretch && brought_.hand == hand ? brought_.at : std::nullopt;
    const auto to = ghost_onward(*track_, stretch, hand, holds, tool.X_WP.p, at);
    if (!to) continue;
    brought_ = {stretch, hand, at, 0};
    return Onward{*to, ghost_ends(*track_, stretch, hand, holds, *at)};
  }
  return std::nullopt;
}

std::optional<GhostControl::Onward> GhostControl::along_with_active_hand(double for_s) {
  const LiveRun* const run = live_.run();
  const bool goes_on = run && track_ && allowed_ && on_ && brought_.at &&
                       brought_.hand == run->active() &&
                       std::count(left_.begin(), left_.end(), brought_.stretch) > 0;
  if (!goes_on) return std::nullopt;
  const auto [stretch, hand, at, beyond] = brought_;
  const ToolState& tool = run->hand(hand).snapshot.tool;
  const auto holds = [&](std::uint32_t ghosts) { return is_held_alike(ghosts, tool.instrument); };
  if (ghost_ends(*track_, stretch, hand, holds, *at)) return std::nullopt;
  GhostPlace place{*at, beyond};
  const auto to = ghost_along(*track_, stretch, hand, holds, tool.X_WP.p, for_s, place);
  if (!to) return std::nullopt;
  brought_ = {stretch, hand, place.at, place.beyond};
  return Onward{*to, ghost_ends(*track_, stretch, hand, holds, place.at)};
}

void GhostControl::poll(const ExerciseRun& exercise) {
  take_prepared();
  std::vector<GhostTool> ghosts;
  const ScenarioState* const state = exercise.state();
  if (track_ && state && live_.run()) {
    follower_.follow(*track_, *state, exercise.now_s());
    left_ = stretches_left(*track_, *state);
    if (std::exchange(restart_, false)) follower_.restart(exercise.now_s());
    for (std::size_t h = 0; allowed_ && on_ && h < track_->hands.size(); ++h) {
      const auto sample = follower_.at(*track_, h, exercise.now_s());
      const auto instrument = sample ? in_tray(sample->instrument) : std::nullopt;
      if (instrument)
        ghosts.push_back({sample->X_WT, *instrument, static_cast<float>(kFullOpacity * strength_)});
    }
  }
  sight_.set_ghosts(std::move(ghosts));
  guide(exercise);
}

// Fades as the ghost does. In a pause nobody is led, and nobody who holds another instrument than
// the expert did there.
void GhostControl::guide(const ExerciseRun& exercise) {
  LiveRun* const run = live_.run();
  const auto stretch = follower_.stretch();
  if (!track_ || !run) return;
  if (!guides_ || !allowed_ || !stretch || exercise.paused()) return lead_nobody();
  if (stretch != led_) led_to_.assign(track_->hands.size(), 0);
  led_ = stretch;
  for (std::size_t h = 0; h < std::min(run->hands(), led_to_.size()); ++h) {
    const ToolState& tool = run->hand(h).snapshot.tool;
    GuideLine line = guide_along(*track_, *stretch, h, tool.X_WP.p, led_to_[h]);
    const auto held = line.on ? in_tray(track_->hands[h][led_to_[h]].instrument) : std::nullopt;
    line.on = line.on && held == tool.instrument;
    line.strength = std::clamp(strength_, 0.0, 1.0);
    run->guide(h, line);
  }
}

GhostModel GhostControl::model() const {
  GhostModel model;
  model.allowed = allowed_;
  model.on = on_;
  model.preparing = job_ != nullptr;
  model.strength = strength_;
  model.guides = guides_;
  model.can_guide = live_.run() && live_.run()->can_guide();
  model.problem = problem_;
  return model;
}

}  // namespace osteon
