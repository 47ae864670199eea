#include <numbers>
#include <string>
#include <utility>

#include "hand_way.h"
#include "knee_orders.h"
#include "osteon/scene/state.h"
#include "osteon/surgeon/placing_surgeon.h"

namespace osteon {
namespace {

constexpr double kCycleStraight_deg = 5, kCycleBent_deg = 95, kScrewFlexion_deg = 30;
constexpr int kWholeCycles = 25, kFewCycles = 5;
constexpr double kTailPull_n = 90, kTailSlack_n = 15;
constexpr double kScrew_m_per_s = 0.0025;  // by its pitch
constexpr double kScrewDeep_m = 0.0255, kScrewShallow_m = 0.011;
constexpr double kScrewLead_m = 0.00125;  // the hand stays so far ahead: 0.5 N on the screw
constexpr double kScrewAside_rad = 24 * std::numbers::pi / 180;

struct FixingHabits {
  int cycles = kWholeCycles;
  double pull_n = kTailPull_n, deep_m = kScrewDeep_m, aside_rad = 0;
};
FixingHabits fixing_habits(const Skill& skill) {
  FixingHabits out;
  if (skill.name == "bad:few_cycles") out.cycles = kFewCycles;
  if (skill.name == "bad:slack_tension") out.pull_n = kTailSlack_n;
  if (skill.name == "bad:shallow_screw") out.deep_m = kScrewShallow_m;
  if (skill.name == "bad:diverging_screw") out.aside_rad = kScrewAside_rad;
  return out;
}

}  // namespace

Result<HandPart> plan_graft_fixing(const Case& the_case, const PlacingPlan& plan,
                                   const Skill& skill, const Pose& from, const std::string& held,
                                   const std::string& screw) {
  if (the_case.joints.empty()) return fail("it has no joint that bends", the_case.name);
  const CaseJoint& knee = the_case.joints.front();
  const FixingHabits habits = fixing_habits(skill);
  KneeOrders orders(0.2, knee.at_deg);
  orders.pull(std::max(habits.pull_n, kTailPull_n));
  for (int i = 0; i < habits.cycles; ++i) {
    orders.bend(kCycleStraight_deg);
    orders.bend(kCycleBent_deg);
  }
  orders.bend(kScrewFlexion_deg);
  orders.pull(habits.pull_n);
  const BoneSnapshot bent = bent_snapshot(the_case, knee, kScrewFlexion_deg);
  const Pose& X_WT = bent.bones[plan.tibia.bone].X_WB;
  const Vec3 mouth = X_WT * plan.tibia.outer_B, inner = X_WT * plan.tibia.mouth_B;
  const Vec3 straight = (mouth - inner).normalized();
  const Vec3 across = straight.cross(X_WT.rotate(Vec3::UnitZ())).normalized();
  const Vec3 out = Eigen::AngleAxisd(habits.aside_rad, across) * straight;
  const double pace = skill.travel_m_per_s / Skill{}.travel_m_per_s;
  HandWay way(held, from, pace);
  way.stay(orders.now_s() + 0.5);
  const auto place = [&](double m) { return held_by_shaft(mouth + m * out, out); };
  change_round(way, round_joint(the_case, bent, inner), screw, place(kHandBefore_m).p, out);
  way.go(place(0.0005), kHandNear_m_per_s);
  way.power(1);
  way.stay(kHandTaken_s);
  way.go(place(-habits.deep_m - kScrewLead_m), kScrew_m_per_s / pace);
  way.stay(2);
  way.power(0);
  way.take(held);
  way.go(place(kHandBefore_m), kHandCarry_m_per_s);
  way.stay(0.5);
  return HandPart{trembling(way.path(), skill.tremor_m, skill.seed + 6), orders.take()};
}

}  // namespace osteon
