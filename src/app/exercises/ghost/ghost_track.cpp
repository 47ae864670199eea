// A ghost follows stages, not the clock. The expert's run is cut into stretches wherever a part of
// a goal became done. Invariant: stretches lie one behind the other, the next begins with the
// sample at which the last ended, so that a ghost which goes from one to the next does not jump.
#include "exercises/ghost/ghost_track.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "osteon/procedure/lc_cusum.h"
#include "osteon/scene/tool_set.h"

namespace osteon {
namespace {

std::uint32_t parts_of_goal(const RuleState& goal) {
  return std::max<std::uint32_t>(1, static_cast<std::uint32_t>(goal.done.size()));
}

std::vector<GoalPart> all_parts(const ScenarioState& state) {
  std::vector<GoalPart> parts;
  for (std::uint32_t g = 0; g < state.goals.size(); ++g)
    for (std::uint32_t i = 0; i < parts_of_goal(state.goals[g]); ++i) parts.push_back({g, i});
  return parts;
}

}  // namespace

bool is_done(const ScenarioState& state, const GoalPart& part) {
  if (part.goal >= state.goals.size()) return false;
  const RuleState& goal = state.goals[part.goal];
  return goal.met || (part.part < goal.done.size() && goal.done[part.part] != 0);
}

GhostTrackMaker::GhostTrackMaker(double tick_s)
    : stride_(std::max<std::uint64_t>(
          1, static_cast<std::uint64_t>(std::llround(1 / (kGhostHz * tick_s))))) {}

void GhostTrackMaker::keep(std::span<const ToolState* const> tools) {
  if (track_.hands.empty()) track_.hands.resize(tools.size());
  for (std::size_t h = 0; h < std::min(tools.size(), track_.hands.size()); ++h)
    track_.hands[h].push_back({tools[h]->X_WP, tools[h]->instrument});
}

void GhostTrackMaker::cut(std::vector<GoalPart> done) {
  const std::size_t kept = track_.hands.empty() ? 0 : track_.hands.front().size();
  if (kept == 0) return;
  track_.stretches.push_back({before_->stage, std::move(done), from_, kept - 1});
  from_ = kept - 1;
}

void GhostTrackMaker::add(std::span<const ToolState* const> tools, const ScenarioState& state) {
  if (tools.empty()) return;
  if (tools[0]->tick % stride_ == 0 || track_.hands.empty()) keep(tools);
  if (!before_) before_ = state;
  std::vector<GoalPart> done;
  for (const GoalPart& part : all_parts(*before_))
    if (!is_done(*before_, part) && (state.stage != before_->stage || is_done(state, part)))
      done.push_back(part);
  if (!done.empty()) cut(std::move(done));
  // Also what is taken back, so that it is told once it has been done again.
  if (state.stage != before_->stage || !(state.goals == before_->goals)) before_ = state;
}

GhostTrack GhostTrackMaker::finish(std::vector<std::string> tray) {
  track_.tray = std::move(tray);
  return std::move(track_);
}

std::vector<std::size_t> stretches_left(const GhostTrack& track, const ScenarioState& state) {
  std::vector<std::size_t> left;
  for (std::size_t i = 0; i < track.stretches.size(); ++i) {
    const GhostStretch& stretch = track.stretches[i];
    const bool helps = std::any_of(stretch.done.begin(), stretch.done.end(),
                                   [&](const GoalPart& part) { return !is_done(state, part); });
    if (stretch.stage == state.stage && state.stage < state.completed_s.size() && helps)
      left.push_back(i);
  }
  return left;
}

std::optional<std::size_t> next_stretch(const GhostTrack& track, const ScenarioState& state) {
  const auto left = stretches_left(track, state);
  return left.empty() ? std::nullopt : std::optional(left.front());
}

std::optional<GhostTrack::Sample> ghost_at(const GhostTrack& track, std::size_t stretch,
                                           std::size_t hand, double since_s) {
  if (stretch >= track.stretches.size() || hand >= track.hands.size() || !std::isfinite(since_s))
    return std::nullopt;
  const GhostStretch& s = track.stretches[stretch];
  const std::vector<GhostTrack::Sample>& samples = track.hands[hand];
  if (s.to >= samples.size() || s.from > s.to) return std::nullopt;
  const double length_s = static_cast<double>(s.to - s.from) / kGhostHz;
  const double in_s = std::fmod(std::max(since_s, 0.0), length_s + kGhostRest_s);
  const double at = std::min(in_s, length_s) * kGhostHz;
  const std::size_t a = s.from + static_cast<std::size_t>(at), b = std::min(a + 1, s.to);
  GhostTrack::Sample sample = samples[std::min(a, s.to)];
  const double share = at - std::floor(at);
  if (samples[b].instrument == sample.instrument && share > 0) {
    sample.X_WT.p += share * (samples[b].X_WT.p - sample.X_WT.p);
    sample.X_WT.q = sample.X_WT.q.slerp(share, samples[b].X_WT.q).normalized();
  }
  if (!is_finite(sample.X_WT)) return std::nullopt;
  return sample;
}

std::optional<Pose> ghost_beside(const GhostTrack& track, std::size_t stretch, std::size_t hand,
                                 std::uint32_t instrument, const Vec3& tip_W) {
  if (stretch >= track.stretches.size() || hand >= track.hands.size()) return std::nullopt;
  const GhostStretch& s = track.stretches[stretch];
  const std::vector<GhostTrack::Sample>& samples = track.hands[hand];
  std::optional<Pose> found;
  for (std::size_t i = s.from; i <= s.to && i < samples.size(); ++i) {
    if (samples[i].instrument != instrument || !is_finite(samples[i].X_WT)) continue;
    const Vec3 away_W = samples[i].X_WT.p - tip_W;
    if (!found || away_W.norm() < (found->p - tip_W).norm()) found = samples[i].X_WT;
  }
  return found;
}

std::optional<Pose> ghost_beside_in_any_size(const GhostTrack& track, std::size_t stretch,
                                             std::size_t hand, std::string_view name,
                                             const Vec3& tip_W) {
  const auto held = parse_tool_name(name);
  std::optional<Pose> found;
  for (std::uint32_t i = 0; held && i < track.tray.size(); ++i) {
    const auto other = parse_tool_name(track.tray[i]);
    if (!other || other->name != held->name) continue;
    const auto one = ghost_beside(track, stretch, hand, i, tip_W);
    if (one && (!found || (one->p - tip_W).norm() < (found->p - tip_W).norm())) found = one;
  }
  return found;
}

namespace {

using Samples = std::vector<GhostTrack::Sample>;

// Goes along the way from `at` until it is `far_m` longer, or at its end `to`.
std::size_t farther(const Samples& samples, std::size_t at, std::size_t to, double far_m) {
  double length_m = 0;
  while (at != to && length_m < far_m) {
    const std::size_t next = to > at ? at + 1 : at - 1;
    length_m += (samples[next].X_WT.p - samples[at].X_WT.p).norm();
    at = next;
  }
  return at;
}

// A tip that is farther from where it was brought to is held up by something.
constexpr double kStillThere_m = 0.012;

// No farther in this stretch with that instrument.
template <class IsHeld>
bool is_way_end(const GhostStretch& stretch, std::size_t at, const IsHeld& is_held) {
  return at >= stretch.to || !is_held(at + 1);
}

}  // namespace

// Ends: each round goes one sample on. A stay has neither length nor turn and is passed at once,
// but for a stretch's end, where the expert saw or touched what he came for. From the end it begins
// once more where the way first came by there: what is to be cleared is not cleared at one go.
std::optional<Pose> ghost_onward(const GhostTrack& track, std::size_t stretch, std::size_t hand,
                                 const std::function<bool(std::uint32_t)>& holds, const Vec3& tip_W,
                                 std::optional<std::size_t>& at) {
  if (stretch >= track.stretches.size() || hand >= track.hands.size()) return std::nullopt;
  const GhostStretch& s = track.stretches[stretch];
  const Samples& samples = track.hands[hand];
  if (s.to >= samples.size() || s.from > s.to) return std::nullopt;
  const auto is_held = [&](std::size_t i) {
    return holds(samples[i].instrument) && is_finite(samples[i].X_WT);
  };
  const auto away_m = [&](std::size_t i) { return (samples[i].X_WT.p - tip_W).norm(); };
  const bool goes_on =
      at && *at >= s.from && *at <= s.to && is_held(*at) && away_m(*at) <= kStillThere_m;
  if (!goes_on) {
    at.reset();
    for (std::size_t i = s.from; i <= s.to; ++i)
      if (is_held(i) && (!at || away_m(i) < away_m(*at))) at = i;
  } else if (is_way_end(s, *at, is_held)) {
    std::size_t first = s.from;
    while (first < *at && !(is_held(first) && away_m(first) <= kStillThere_m)) ++first;
    at = first;
  }
  if (!at) return std::nullopt;
  const Quat begun_q = samples[*at].X_WT.q;
  double length_m = 0;
  while (!is_way_end(s, *at, is_held) && length_m < kStepOn_m &&
         begun_q.angularDistance(samples[*at].X_WT.q) < kTurnOn_rad) {
    length_m += (samples[*at + 1].X_WT.p - samples[*at].X_WT.p).norm();
    ++*at;
  }
  return samples[*at].X_WT;
}

std::optional<Pose> ghost_along(const GhostTrack& track, std::size_t stretch, std::size_t hand,
                                const std::function<bool(std::uint32_t)>& holds, const Vec3& tip_W,
                                double for_s, GhostPlace& place) {
  if (stretch >= track.stretches.size() || hand >= track.hands.size()) return std::nullopt;
  const GhostStretch& s = track.stretches[stretch];
  const Samples& samples = track.hands[hand];
  if (s.to >= samples.size() || place.at < s.from || place.at > s.to) return std::nullopt;
  const auto is_held = [&](std::size_t i) {
    return holds(samples[i].instrument) && is_finite(samples[i].X_WT);
  };
  if (!is_held(place.at)) return std::nullopt;
  if (!((samples[place.at].X_WT.p - tip_W).norm() <= kStillThere_m)) return std::nullopt;
  place.beyond += std::isfinite(for_s) ? std::max(for_s, 0.0) * kGhostHz : 0.0;
  for (; place.beyond >= 1 && !is_way_end(s, place.at, is_held); place.beyond -= 1) ++place.at;
  place.beyond = std::min(place.beyond, 1.0);
  return samples[place.at].X_WT;
}

bool ghost_ends(const GhostTrack& track, std::size_t stretch, std::size_t hand,
                const std::function<bool(std::uint32_t)>& holds, std::size_t at) {
  const Samples& samples = track.hands[hand];
  return is_way_end(track.stretches[stretch], at, [&](std::size_t i) {
    return holds(samples[i].instrument) && is_finite(samples[i].X_WT);
  });
}

// A place where the expert stayed has no length, so a stay does not hold up who is led.
GuideLine guide_along(const GhostTrack& track, std::size_t stretch, std::size_t hand,
                      const Vec3& tip_W, std::size_t& at) {
  constexpr double kBeside_m = 0.001, kStraight_m = 0.0005;
  GuideLine line;
  if (stretch >= track.stretches.size() || hand >= track.hands.size()) return line;
  const GhostStretch& s = track.stretches[stretch];
  const Samples& samples = track.hands[hand];
  if (s.to >= samples.size() || s.from > s.to) return line;
  at = std::clamp(at, s.from, s.to);
  const std::size_t last = farther(samples, at, s.to, kGuideAhead_m);
  double nearest_m = std::numeric_limits<double>::infinity();
  for (std::size_t i = farther(samples, at, s.from, kGuideBack_m); i <= last; ++i) {
    const double far_m = (samples[i].X_WT.p - tip_W).norm();
    if (!(far_m <= nearest_m)) continue;  // of equals the last
    nearest_m = far_m;
    at = i;
  }
  line.p_W = samples[at].X_WT.p;
  line.on = is_finite(line.p_W) && std::isfinite(nearest_m);
  line.strength = 1;
  const Vec3 way_W = samples[farther(samples, at, s.to, kBeside_m)].X_WT.p -
                     samples[farther(samples, at, s.from, kBeside_m)].X_WT.p;
  if (way_W.norm() > kStraight_m) line.along_W = way_W.normalized();
  return line;
}

void GhostFollower::follow(const GhostTrack& track, const ScenarioState& state, double now_s) {
  const auto next = next_stretch(track, state);
  if (next != stretch_) since_s_ = now_s;
  stretch_ = next;
}

std::optional<GhostTrack::Sample> GhostFollower::at(const GhostTrack& track, std::size_t hand,
                                                    double now_s) const {
  return stretch_ ? ghost_at(track, *stretch_, hand, now_s - since_s_) : std::nullopt;
}

double ghost_strength(const std::vector<bool>& passed) {
  if (passed.empty()) return 1;
  const LcCusumOptions options;
  const LcCusum curve = lc_cusum(passed, options);
  if (curve.relapse_at >= 0) return 1;
  if (curve.competent_at >= 0) return 0;
  return std::clamp(1 - curve.s.back() / options.h, 0.0, 1.0);
}

}  // namespace osteon
