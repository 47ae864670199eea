#include <algorithm>
#include <cmath>
#include <numeric>

#include "ring_plan.h"
#include "way_draft.h"

namespace osteon {
namespace {

constexpr double kGuided_m_per_s = 0.014;     // along a groove
constexpr double kFeed_m_per_s = 0.008;       // of a burr
constexpr double kWayOver_m = 0.012;          // above all, between places
constexpr double kFromGrooveSide_m = 0.0006;  // the shaft leans back: the tip keeps to the far side
constexpr double kInFrontOfGroove_m = 0.012, kFromGroove_m = 0.004;
constexpr double kBelowHole_m = 0.008;  // where the plate is whole
constexpr double kBeforePlate_m = 0.004;
constexpr double kBeforeHole_m = 0.015, kBehindHole_m = 0.001;
constexpr double kIntoHole = 0.4;  // of the way through: where a slanted needle is in the middle
constexpr double kCutMore_m = 0.00025;  // beyond the line, so that nothing is left before it
constexpr double kFinish_m = 0.0006;
constexpr double kRow_m = 0.0009;  // from one row of a burr to the next

// On the free floor between the portal and the first mark, where no wall hides the tip.
void press_before_groove(const Vec3& first_W, WayDraft& draft) {
  Vec3 towards = draft.tool.portal_W - first_W;
  towards.z() = 0;
  const Vec3 floor_W = first_W + kInFrontOfGroove_m * towards.normalized();
  draft.press_hard(raised(floor_W, kFromGroove_m), raised(floor_W, -1));
}

// From mark to mark, a little towards the side that the shaft leans away from.
void plan_groove(const PlannedRule& goal, WayDraft& draft) {
  std::vector<Vec3> places = goal.places_W;
  for (Vec3& place : places) {
    Vec3 away = place - draft.tool.portal_W;
    away.z() = 0;
    place += kFromGrooveSide_m * away.normalized();
  }
  if (draft.breaks("pressed_over")) press_before_groove(goal.places_W.front(), draft);
  draft.go(raised(places.front(), kWayOver_m), draft.inside());
  for (std::size_t i = 0; i < places.size(); ++i) {
    draft.go(places[i], i == 0 ? draft.skill.approach_m_per_s : kGuided_m_per_s, true);
    if (i != places.size() / 2 || !draft.breaks("strayed")) continue;
    draft.go(raised(places[i], 2.5 * draft.fault.at("off_mm") / 1000), draft.inside());
    draft.legs.back().wait_s = draft.fault.at("for_s") + 0.7;
    draft.go(places[i], draft.skill.approach_m_per_s);
  }
  draft.go(raised(places.back(), kWayOver_m), draft.inside());
}

void pass_hole(const Vec3& in_W, const Vec3& out_W, WayDraft& draft) {
  const Vec3 way = out_W - in_W;
  const Vec3 middle = in_W + kIntoHole * way;
  const Vec3 along = (middle - draft.tool.portal_W).normalized();
  const double slant = along.dot(way) / way.norm();
  const double through = ((1 - kIntoHole) * way.norm() + kBehindHole_m) / std::max(0.2, slant);
  draft.go(middle - kBeforeHole_m * along, draft.inside());
  draft.go(middle + through * along, draft.inside(), true);
  draft.go(middle - kBeforeHole_m * along, draft.inside());
}

void plan_holes(const PlannedRule& goal, WayDraft& draft) {
  std::vector<std::size_t> order(goal.places_W.size() / 2);
  std::iota(order.begin(), order.end(), std::size_t{0});
  if (draft.breaks("passed_out_of_order") && order.size() > 1) order.insert(order.begin(), 1);
  for (const std::size_t pair : order) {
    const Vec3 &in_W = goal.places_W[2 * pair], &out_W = goal.places_W[2 * pair + 1];
    if (draft.breaks("pressed_over") && pair == 1) {
      // Squarely on the plate, below the holes.
      const Vec3 below = raised(in_W, -kBelowHole_m);
      draft.press_hard(below - kBeforePlate_m * (out_W - in_W).normalized(), below);
    }
    pass_hole(in_W, out_W, draft);
  }
}

// What a round burr has left at the edges of the plate: the last row again, above and below it.
// Where nothing is left the exercise is over before.
void finish_rows(const Vec3& at_W, const Vec3& row_W, WayDraft& draft) {
  Vec3 here = at_W;
  const Vec3 back = draft.legs[draft.legs.size() - 2].to_W - here;
  Vec3 way = back.dot(row_W) > 0 ? row_W : Vec3(-row_W);
  for (const double up_m : {kFinish_m, -kFinish_m}) {
    draft.go(raised(here, up_m), kFeed_m_per_s);
    draft.go(raised(here + way, up_m), kFeed_m_per_s, true);
    here += way;
    way = -way;
  }
}

// Rows along the edge, each a little deeper than the one before, until the line is reached.
void plan_rows(const PlannedRule& goal, const Case& the_case, WayDraft& draft) {
  const Bone& bone = the_case.bones[the_case.find(goal.rule.subjects.front()).index];
  Vec3 begin = goal.places_W.front(), end = goal.places_W.back();
  const Vec3 along = (end - begin).normalized();
  Vec3 inward = bone.X_WB.p - 0.5 * (begin + end);
  inward = (inward - inward.dot(along) * along).normalized();
  const double r = draft.tool.tip_radius_m;
  const double last = goal.rule.numbers.at("within_mm") / 1000 - r + kCutMore_m;
  begin -= (r + 0.001) * along;
  end += (r + 0.001) * along;
  draft.go(raised(begin - 2 * r * inward, kWayOver_m), draft.inside());
  draft.go(begin - 2 * r * inward, draft.inside());
  draft.legs.back().power = 1;
  bool there = false;
  for (double depth = std::fmod(last + r, kRow_m) - r; depth < last + 0.5 * kRow_m;
       depth += kRow_m, there = !there) {
    draft.go((there ? end : begin) + depth * inward, kFeed_m_per_s);
    draft.go((there ? begin : end) + depth * inward, kFeed_m_per_s, true);
  }
  Vec3 at = draft.legs.back().to_W;
  if (draft.breaks("cut_outside") || draft.breaks("pressed_over")) {
    // Before the last row, after which the exercise may be over.
    const WayLeg back = draft.legs.back();
    draft.legs.pop_back();
    at = draft.legs.back().to_W;
    if (draft.breaks("cut_outside")) {
      const Vec3 beside = 0.5 * (begin + end) + (last - kRow_m) * inward;
      draft.go(beside, kFeed_m_per_s);
      draft.go(beside + (kRow_m + 2 * draft.fault.at("beyond_mm") / 1000) * inward, kFeed_m_per_s);
      draft.go(beside, kFeed_m_per_s);
    } else {
      const Vec3 over = raised(bone.X_WB.p, kWayOver_m);
      draft.go(raised(at, kWayOver_m), draft.inside());
      draft.legs.back().power = 0;
      draft.press_hard(over, bone.X_WB.p);
      draft.go(raised(at, kWayOver_m), draft.inside());
    }
    draft.go(at, kFeed_m_per_s);
    draft.legs.back().power = 1;
    draft.legs.push_back(back);
    at = back.to_W;
  }
  finish_rows(at, end - begin, draft);
  at = draft.legs.back().to_W;
  draft.go(raised(at - 2 * r * inward, kWayOver_m), draft.inside());
  draft.legs.back().power = 0;
}

}  // namespace

std::vector<WayLeg> plan_way(const ScenarioPlan& plan, const Case& the_case, const Skill& skill,
                             const WayTool& tool) {
  WayDraft draft{skill, tool, {}, {}};
  for (const PlannedRule& error : plan.errors)
    if (error.rule.kind == skill.fault) draft.fault = error.rule.numbers;
  for (const auto& goals : plan.goals)
    for (const PlannedRule& goal : goals) {
      if (goal.rule.kind == "reached_in_order") plan_groove(goal, draft);
      if (goal.rule.kind == "passed_in_order") plan_holes(goal, draft);
      if (goal.rule.kind == "ringed") plan_rings(goal, the_case, draft);
      if (goal.rule.kind == "removed") plan_rows(goal, the_case, draft);
    }
  return draft.legs;
}

}  // namespace osteon
