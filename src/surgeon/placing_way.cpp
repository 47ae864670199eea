#include <algorithm>
#include <array>
#include <string>
#include <string_view>
#include <utility>

#include "hand_way.h"
#include "osteon/scene/placing.h"
#include "osteon/surgeon/placing_surgeon.h"

namespace osteon {
namespace {

constexpr double kPassDraw_m_per_s = 0.03, kPassThread_m = 0.03;
constexpr double kPinBeyond_m = 0.022;  // the cortex: the thread's end has come into the joint
constexpr double kPinTooFar_m = 0.065;
constexpr double kGrasperOut_m = 0.035;
// A hand goes ahead of the thread that it draws by the pull over its coupling, 2.5 to 7 mm: the
// button is then 2 to 6 mm beyond the place where it is out, as far as nothing comes under it.
constexpr double kBeyondOut_m = 0.009;

constexpr std::array<std::string_view, 4> kPlacingFaults{"lost_thread", "unflipped_button",
                                                         "soft_tissue", "flipped_in_muscle"};

// Where the tunnels are, in World.
struct PlacesNow {
  Vec3 f_in, f_out, f_way, t_in, t_out, t_way;
};
PlacesNow places_of(const Case& the_case, const PlacingPlan& plan) {
  const Pose &X_WF = the_case.bones[plan.femur.bone].X_WB,
             &X_WT = the_case.bones[plan.tibia.bone].X_WB;
  PlacesNow at{X_WF * plan.femur.mouth_B, X_WF * plan.femur.outer_B, {},
               X_WT * plan.tibia.mouth_B, X_WT * plan.tibia.outer_B, {}};
  at.f_way = (at.f_out - at.f_in).normalized();
  at.t_way = (at.t_out - at.t_in).normalized();
  return at;
}

RoundJoint knee_of(const Case& the_case, const PlacesNow& at) {
  return round_joint(the_case, rest_snapshot(the_case), 0.5 * (at.f_in + at.t_in));
}

void pass_pin(HandWay& way, const PlacesNow& at, double to_m) {
  const auto place = [&](double m) { return held_by_shaft(at.f_in + m * at.f_way, -at.f_way); };
  way.go(place(-0.010), kHandCarry_m_per_s);
  way.go(place(-0.001), kHandNear_m_per_s);
  way.stay(kHandTaken_s);
  way.go(place(to_m), kHandNear_m_per_s);
  way.stay(1);
  way.go(place(-0.020), 3 * kHandNear_m_per_s);
  way.go(place(-kHandBefore_m), kHandCarry_m_per_s);
}

void fetch_thread(HandWay& way, const RoundJoint& knee, const PlacesNow& at) {
  const double length = (at.t_out - at.t_in).norm();
  const auto place = [&](double m) { return held_by_shaft(at.t_in + m * at.t_way, at.t_way); };
  // The thread's end lies over the mouth, towards the femur's.
  const Vec3 end = at.t_in + 0.010 * (at.f_in - at.t_in).normalized();
  change_round(way, knee, "grasper", at.t_out + kHandBefore_m * at.t_way, at.t_way);
  way.go(place(length + 0.002), kHandNear_m_per_s);
  way.stay(kHandTaken_s);
  way.go(place(at.t_way.dot(end - at.t_in)), kHandNear_m_per_s);
  way.jaw(1);
  way.jaw(0);
  way.go(place(length + kGrasperOut_m), kHandNear_m_per_s);
  way.jaw(1);
  way.jaw(0);
  way.go(place(length + kHandBefore_m), kHandCarry_m_per_s);
}

void draw_graft(HandWay& way, const RoundJoint& knee, const PlacesNow& at, double drawn_m) {
  const auto place = [&](double m) { return held_by_shaft(at.f_out + m * at.f_way, at.f_way); };
  change_round(way, knee, "clamp", at.f_out + kHandBefore_m * at.f_way, at.f_way);
  way.jaw(1);
  way.go(place(kPassThread_m), kHandNear_m_per_s);
  way.jaw(0);
  way.go(place(kPassThread_m + drawn_m), kPassDraw_m_per_s);
  way.stay(1.5);
  way.jaw(1);
  way.stay(0.5);
}

Result<std::string> placing_fault(const Skill& skill) {
  const std::string fault = skill.name.starts_with("bad:") ? skill.name.substr(4) : std::string();
  if (fault.empty() ||
      std::find(kPlacingFaults.begin(), kPlacingFaults.end(), fault) != kPlacingFaults.end())
    return fault;
  return fail("no virtual surgeon can make the error '" + fault + "'", "surgeon",
              "Use lost_thread, unflipped_button, soft_tissue or flipped_in_muscle");
}

Result<PlacingPlan> plan_in(const Case& the_case) {
  auto plan = find_placing(the_case);
  if (!plan)
    return fail("the case has no tunnels for a graft", the_case.name,
                "Use a knee with the finding acl_tunnels=anatomic");
  return *plan;
}

double passed_to(const std::string& fault, const PlacingPlan& plan) {
  return plan.femur.length_m() + (fault == "lost_thread" ? kPinTooFar_m : kPinBeyond_m);
}

double drawn_by(const std::string& fault, double out_m) {
  if (fault == "unflipped_button") return out_m - 0.002;
  if (fault == "soft_tissue") return out_m + 0.0135;
  if (fault == "flipped_in_muscle") return out_m + 0.026;
  return out_m + kBeyondOut_m;
}

}  // namespace

Result<ProbePath> plan_graft_placing(const Case& the_case, const Skill& skill) {
  const auto plan = plan_in(the_case);
  if (!plan) return tl::unexpected(plan.error());
  const auto fault = placing_fault(skill);
  if (!fault) return tl::unexpected(fault.error());
  const PlacesNow at = places_of(the_case, *plan);
  const double pace = skill.travel_m_per_s / Skill{}.travel_m_per_s;
  const RoundJoint knee = knee_of(the_case, at);
  HandWay way("passing_pin", held_by_shaft(at.f_in - kHandBefore_m * at.f_way, -at.f_way), pace);
  way.stay(0.3);
  pass_pin(way, at, passed_to(*fault, *plan));
  fetch_thread(way, knee, at);
  draw_graft(way, knee, at, drawn_by(*fault, plan->button_out_m()));
  return trembling(way.path(), skill.tremor_m, skill.seed + 5);
}

ProbePath plan_graft_placing(const Case& the_case, const PlacingPlan& plan, const Skill& skill,
                             const Pose& from, const std::string& held) {
  const std::string fault = placing_fault(skill).value_or("");
  const PlacesNow at = places_of(the_case, plan);
  const double pace = skill.travel_m_per_s / Skill{}.travel_m_per_s;
  const RoundJoint knee = knee_of(the_case, at);
  HandWay way(held, from, pace);
  way.go(held_by_shaft(at.f_in - kHandBefore_m * at.f_way, -at.f_way), kHandCarry_m_per_s);
  way.take("passing_pin");
  pass_pin(way, at, passed_to(fault, plan));
  fetch_thread(way, knee, at);
  draw_graft(way, knee, at, drawn_by(fault, plan.button_out_m()));
  way.go(held_by_shaft(at.f_out + kRound_m * at.f_way, at.f_way), kHandCarry_m_per_s);
  return trembling(way.path(), skill.tremor_m, skill.seed + 5);
}

Result<ProbePath> plan_placing_scope(const Case& the_case, const Vec3& portal_W,
                                     const std::string& instrument) {
  const auto plan = plan_in(the_case);
  if (!plan) return tl::unexpected(plan.error());
  const PlacesNow at = places_of(the_case, *plan);
  constexpr double kOff_m = 0.028;
  const Vec3 look = 0.5 * (at.f_in + at.t_in) - portal_W;
  const Vec3 in = look.normalized();
  const double deep = std::max(0.005, look.norm() - kOff_m);
  AclWay way(instrument, 0, held_by_shaft(portal_W - 0.03 * in, -in), 1);
  way.go_at(held_by_shaft(portal_W + deep * in, -in), kHandNear_m_per_s);
  way.stay(1);
  return way.path();
}

}  // namespace osteon
