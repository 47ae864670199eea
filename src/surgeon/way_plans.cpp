#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

#include "osteon/surgeon/way_surgeon.h"

namespace osteon {
namespace {

constexpr double kWayInsideShare = 0.3;       // of the speed outside
constexpr double kGuided_m_per_s = 0.014;     // along a groove
constexpr double kFeed_m_per_s = 0.008;       // of a burr
constexpr double kWayOver_m = 0.012;          // above all, between places
constexpr double kFromGrooveSide_m = 0.0006;  // the shaft leans back: the tip keeps to the far side
constexpr double kBeforeHole_m = 0.015, kBehindHole_m = 0.001;
constexpr double kIntoHole = 0.4;  // of the way through: where a slanted needle is in the middle
constexpr double kCutMore_m = 0.00025;  // beyond the line, so that nothing is left before it
constexpr double kRow_m = 0.0009;       // from one row of a burr to the next
constexpr double kWayTooHard_n = 6.5;
constexpr double kBeyondBone_m = 0.02;

// A way that is being planned.
struct WayDraft {
  const Skill& skill;
  WayTool tool;
  std::map<std::string, double> fault;  // numbers of the rule that is broken on purpose
  std::vector<WayLeg> legs;

  double inside() const { return kWayInsideShare * skill.travel_m_per_s; }
  bool breaks(const char* rule) const { return skill.fault == rule; }
  void go(const Vec3& to_W, double m_per_s, bool place = false) {
    WayLeg leg;
    leg.to_W = to_W;
    leg.m_per_s = m_per_s;
    leg.place = place;
    legs.push_back(leg);
  }
  // Leans on what is there, and comes back.
  void press_hard(const Vec3& from_W, const Vec3& to_W) {
    go(from_W, inside());
    go(from_W + (to_W - from_W).normalized() * kBeyondBone_m, skill.approach_m_per_s);
    legs.back().press_n = kWayTooHard_n;
    legs.back().wait_s = 0.3;
    legs.back().leans = true;
    go(from_W, inside());
    legs.back().leans = true;
  }
};

Vec3 raised(const Vec3& p_W, double z_m) { return {p_W.x(), p_W.y(), p_W.z() + z_m}; }

// From mark to mark, a little towards the side that the shaft leans away from.
void plan_groove(const PlannedRule& goal, WayDraft& draft) {
  std::vector<Vec3> places = goal.places_W;
  for (Vec3& place : places) {
    Vec3 away = place - draft.tool.portal_W;
    away.z() = 0;
    place += kFromGrooveSide_m * away.normalized();
  }
  draft.go(raised(places.front(), kWayOver_m), draft.inside());
  for (std::size_t i = 0; i < places.size(); ++i) {
    draft.go(places[i], i == 0 ? draft.skill.approach_m_per_s : kGuided_m_per_s, true);
    if (i != places.size() / 2 || !draft.breaks("strayed")) continue;
    draft.go(raised(places[i], 2.5 * draft.fault.at("off_mm") / 1000), draft.inside());
    draft.legs.back().wait_s = draft.fault.at("for_s") + 0.7;
    draft.go(places[i], draft.skill.approach_m_per_s);
  }
  // On the floor, before the last mark: with that the exercise is over.
  if (draft.breaks("pressed_over") && places.size() > 1) {
    const WayLeg last = draft.legs.back();
    draft.legs.pop_back();
    const Vec3 before = places[places.size() - 2];
    draft.press_hard(before, raised(before, -1));
    draft.legs.push_back(last);
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
      // Between two holes, where the plate is.
      const Vec3 between = 0.5 * (goal.places_W[2 * pair - 2] + in_W);
      const Vec3 back = (draft.tool.portal_W - between).normalized();
      draft.press_hard(between + kBeforeHole_m * back, between);
    }
    pass_hole(in_W, out_W, draft);
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
      if (goal.rule.kind == "removed") plan_rows(goal, the_case, draft);
    }
  return draft.legs;
}

}  // namespace osteon
