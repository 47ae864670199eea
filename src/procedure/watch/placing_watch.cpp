#include "osteon/procedure/placing_watch.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "watch/watch_event.h"

namespace osteon {
double excursion_m(const BentGraft& bent) {
  double least = 0, most = 0;
  for (const double length : bent.lengths_m) {
    if (length == 0) continue;
    least = least == 0 ? length : std::min(least, length);
    most = std::max(most, length);
  }
  return most - least;
}

std::optional<PlacingPlan> PlacingWatch::plan() const {
  return seen_.on ? std::optional<PlacingPlan>(seen_.plan) : std::nullopt;
}

void PlacingWatch::add(std::uint64_t tick, const BoneSnapshot& bones, std::vector<Event>& out) {
  const GraftPlacingState &now = bones.placing, &was = seen_;
  if (!now.on) {
    seen_ = {};
    return;
  }
  const double beyond_mm = 1e3 * (now.drawn_m - now.plan.button_out_m());
  if (now.lost > was.lost) out.push_back(event_of(tick, kThreadLost, {double(now.lost), 0, 0}));
  if (now.phase != was.phase && now.phase == PlacingPhase::kThreadInside &&
      was.phase == PlacingPhase::kEmpty)
    out.push_back(event_of(tick, kThreadLaid, {double(now.lost), 0, 0}));
  if (now.phase != was.phase && now.phase == PlacingPhase::kThreadOut &&
      was.phase != PlacingPhase::kTurned)
    out.push_back(event_of(tick, kThreadOut, {0, 0, 0}));
  if (now.let_go_early > was.let_go_early)
    out.push_back(event_of(tick, kButtonLetGo, {-beyond_mm, now.most_pull_n, 0}));
  if (now.phase != was.phase && now.phase == PlacingPhase::kTurned)
    out.push_back(event_of(tick, kButtonTurned, {1e3 * now.gap_m, now.most_pull_n, beyond_mm}));
  add_fixing(tick, bones, out);
  seen_ = now;
}

// Bending with the graft in it, and the screw.
void PlacingWatch::add_fixing(std::uint64_t tick, const BoneSnapshot& bones,
                              std::vector<Event>& out) {
  const GraftPlacingState& now = bones.placing;
  if (now.phase != PlacingPhase::kTurned) {
    bent_ = {};
    cycles_ = bones.bend.cycles;
    return;
  }
  if (bones.bend.on && !is_loaded(bones.exam)) {
    const double place = bones.bend.now_deg / 10;
    const auto n = static_cast<std::size_t>(std::clamp(std::round(place), 0.0, 13.0));
    constexpr double kNear = 0.05;
    if (std::abs(place - static_cast<double>(n)) < kNear)
      bent_.lengths_m[n] = placing_between_m(now.plan, bones);
  }
  if (bones.bend.cycles > cycles_)
    out.push_back(event_of(tick, kKneeCycled, {double(bones.bend.cycles), now.tension_n, 0}));
  cycles_ = bones.bend.cycles;
  const PlacingScrew& screw = now.screw;
  if (!screw.done || seen_.screw.done) return;
  const double cosine =
      screw.out_B.dot((now.plan.tibia.outer_B - now.plan.tibia.mouth_B).normalized());
  const double apart_deg = 180 / std::numbers::pi * std::acos(std::clamp(cosine, -1.0, 1.0));
  out.push_back(event_of(tick, kScrewIn, {1e3 * screw.in_m, apart_deg, screw.tension_n}));
  out.push_back(event_of(tick, kGraftFixed,
                         {screw.flexion_deg, double(screw.cycles),
                          1e3 * (screw.width_m - 2 * now.plan.tibia.radius_m)}));
}

}  // namespace osteon
