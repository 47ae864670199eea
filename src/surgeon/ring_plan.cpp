#include "ring_plan.h"

#include <algorithm>
#include <cmath>

#include "osteon/scene/rings.h"

namespace osteon {
namespace {

constexpr double kOpen = 0.5;
constexpr double kPastMiddle_m = 0.0006;  // the tip reaches so far beyond the ring's middle line
constexpr double kBeforeRing_m = 0.018;
constexpr double kOverPeg_m = 0.003;    // between a peg's top and what is carried over it
constexpr double kDropFrom_m = 0.0006;  // over where a ring comes to lie
constexpr double kLookAtRing_s = 0.15, kJawsTake_s = 0.25, kFalls_s = 1;
constexpr double kInFront_m = 0.012;  // of a ring: where the floor is free

// A tool whose shaft passes the portal, the hinge of its jaws level.
Pose level_at(const Vec3& tip_W, const Vec3& portal_W) {
  return {tip_W, level_jaws((portal_W - tip_W).normalized())};
}

// Where the tip must be so that what it holds at `held_P` comes to `goal_W`: the shaft turns about
// the portal meanwhile, by little.
Vec3 tip_for(const Vec3& goal_W, const Vec3& held_P, const Vec3& start_W, const Vec3& portal_W) {
  constexpr int kRounds = 12;
  Vec3 tip_W = start_W;
  for (int n = 0; n < kRounds; ++n) tip_W = goal_W - level_at(tip_W, portal_W).rotate(held_P);
  return tip_W;
}

struct RingTrip {
  Vec3 center_W = Vec3::Zero();  // of the ring
  double top_z = 0;              // of its peg
  double half_m = 0;
  Vec3 grip_W = Vec3::Zero();  // of the tip
  Vec3 held_P = Vec3::Zero();  // the ring's middle in Tool

  Vec3 tip_when(const Vec3& center, const Vec3& portal_W) const {
    return tip_for(center, held_P, grip_W, portal_W);
  }
};

RingTrip trip_of(const RingSet& set, const RingShape& ring, const Case& the_case,
                 const Vec3& portal_W) {
  RingTrip trip;
  trip.center_W = the_case.bones[ring.bone].X_WB * ring.center_B;
  trip.half_m = 0.5 * ring.thick_m;
  const RingPeg* peg = peg_in_ring(set, ring, trip.center_W);
  trip.top_z = peg ? peg->top_W.z() : trip.center_W.z();
  Vec3 ahead = trip.center_W - portal_W;
  ahead.z() = 0;
  trip.grip_W = trip.center_W - (ring.middle_m - kPastMiddle_m) * ahead.normalized();
  trip.held_P = level_at(trip.grip_W, portal_W).inverse() * trip.center_W;
  return trip;
}

void take_ring(const RingTrip& trip, WayDraft& draft) {
  const Vec3 back = (draft.tool.portal_W - trip.grip_W).normalized();
  draft.go(trip.grip_W + kBeforeRing_m * back, draft.inside());
  draft.legs.back().jaw = kOpen;
  draft.go(trip.grip_W, draft.skill.approach_m_per_s);
  draft.legs.back().wait_s = kLookAtRing_s;
  draft.go(trip.grip_W, draft.skill.approach_m_per_s);
  draft.legs.back().jaw = 0;
  draft.legs.back().wait_s = kJawsTake_s;
}

void let_ring_go(const Vec3& tip_W, double wait_s, bool place, WayDraft& draft) {
  draft.go(tip_W, draft.skill.approach_m_per_s);
  draft.legs.back().jaw = kOpen;
  draft.legs.back().wait_s = wait_s;
  const Vec3 back = (draft.tool.portal_W - tip_W).normalized();
  draft.go(tip_W + kBeforeRing_m * back, draft.inside(), place);
}

}  // namespace

void plan_rings(const PlannedRule& goal, const Case& the_case, WayDraft& draft) {
  const RingSet set = find_rings(the_case);
  const Vec3& portal_W = draft.tool.portal_W;
  const std::size_t begin = draft.legs.size();
  const std::size_t trips = std::min(set.rings.size(), goal.places_W.size());
  for (std::size_t i = 0; i < trips; ++i) {
    const RingTrip trip = trip_of(set, set.rings[i], the_case, portal_W);
    const Vec3& top_W = goal.places_W[i];
    const double over = std::max(trip.top_z, top_W.z()) + trip.half_m + kOverPeg_m;
    const auto at = [&](const Vec3& p_W, double z) {
      return trip.tip_when({p_W.x(), p_W.y(), z}, portal_W);
    };
    take_ring(trip, draft);
    draft.go(at(trip.center_W, over), draft.skill.approach_m_per_s);
    if (draft.breaks("ring_dropped") && i == trips / 2) {
      const Vec3 between = 0.5 * (trip.center_W + top_W);
      draft.go(at(between, over), draft.inside());
      let_ring_go(at(between, over), kFalls_s, true, draft);
      continue;
    }
    draft.go(at(top_W, over), draft.inside());
    const double low = top_W.z() - (trip.top_z - trip.center_W.z()) + kDropFrom_m;
    draft.go(at(top_W, low), draft.skill.approach_m_per_s);
    let_ring_go(at(top_W, low), kJawsTake_s, true, draft);
    if (!draft.breaks("pressed_over") || i > 0) continue;
    Vec3 ahead = trip.center_W - portal_W;
    ahead.z() = 0;
    const Vec3 floor_W = trip.center_W - kInFront_m * ahead.normalized();
    draft.press_hard(raised(floor_W, kOverPeg_m), raised(floor_W, -1));
  }
  for (std::size_t i = begin; i < draft.legs.size(); ++i) draft.legs[i].level = true;
}

}  // namespace osteon
