#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <string_view>
#include <utility>

#include "acl_way.h"
#include "osteon/scene/placing.h"
#include "osteon/surgeon/placing_surgeon.h"

namespace osteon {
namespace {

constexpr double kPassCarry_m_per_s = 0.2, kPassNear_m_per_s = 0.03, kPassDraw_m_per_s = 0.03;
constexpr double kPassRound_m = 0.25;  // so far from the joint's middle instruments are changed
constexpr double kPassTaken_s = 0.5, kPassJaw_s = 0.4;
constexpr double kPassBefore_m = 0.08, kPassThread_m = 0.03;
constexpr double kPinBeyond_m = 0.022;  // the cortex: the thread's end has come into the joint
constexpr double kPinTooFar_m = 0.065;
constexpr double kGrasperOut_m = 0.035;
// A hand goes ahead of the thread that it draws by the pull over its coupling, 2.5 to 7 mm.
constexpr double kBeyondOut_m = 0.0075;

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

// One hand that changes instruments, far from the knee.
class PlacingHandWay {
 public:
  PlacingHandWay(const std::string& instrument, const Pose& X, const Vec3& middle_W, double pace)
      : pace_(pace), middle_W_(middle_W) {
    path_.with_instruments = true;
    at_.X_WD = X;
    at_.instrument = instrument;
    path_.samples.push_back(at_);
  }
  void go(const Pose& X, double m_per_s) {
    const double seconds = (X.p - at_.X_WD.p).norm() / (m_per_s * pace_);
    at_.X_WD = X;
    stay(std::max(seconds, 0.05));
  }
  void stay(double seconds) {
    at_.time_s += seconds;
    path_.samples.push_back(at_);
  }
  void jaw(double open) {
    stay(0.02);
    at_.jaw = open;
    path_.samples.back().jaw = open;
    stay(kPassJaw_s);
  }
  // Out, round the knee with another instrument, and in towards a place.
  void change(const std::string& instrument, const Vec3& to_W, const Vec3& back_W) {
    const Vec3 from = (at_.X_WD.p - middle_W_).normalized();
    const Vec3 to = (to_W - middle_W_).normalized();
    go({middle_W_ + kPassRound_m * from, at_.X_WD.q}, kPassCarry_m_per_s);
    stay(0.2);
    at_.instrument = instrument;
    at_.jaw = 0;
    path_.samples.back() = at_;
    stay(0.3);
    constexpr int kSteps = 6;
    for (int i = 1; i <= kSteps; ++i) {
      const double share = static_cast<double>(i) / kSteps;
      const Vec3 way = ((1 - share) * from + share * to).normalized();
      go(held_by_shaft(middle_W_ + kPassRound_m * way, back_W), kPassCarry_m_per_s);
    }
    go(held_by_shaft(to_W, back_W), kPassCarry_m_per_s);
  }
  const ProbePath& path() const { return path_; }

 private:
  double pace_;
  Vec3 middle_W_;
  ProbePath path_;
  PathSample at_;
};

void pass_pin(PlacingHandWay& way, const PlacesNow& at, double to_m) {
  const auto place = [&](double m) { return held_by_shaft(at.f_in + m * at.f_way, -at.f_way); };
  way.go(place(-0.010), kPassCarry_m_per_s);
  way.go(place(-0.001), kPassNear_m_per_s);
  way.stay(kPassTaken_s);
  way.go(place(to_m), kPassNear_m_per_s);
  way.stay(1);
  way.go(place(-0.020), 3 * kPassNear_m_per_s);
  way.go(place(-kPassBefore_m), kPassCarry_m_per_s);
}

void fetch_thread(PlacingHandWay& way, const PlacesNow& at) {
  const double length = (at.t_out - at.t_in).norm();
  const auto place = [&](double m) { return held_by_shaft(at.t_in + m * at.t_way, at.t_way); };
  // The thread's end lies over the mouth, towards the femur's.
  const Vec3 end = at.t_in + 0.010 * (at.f_in - at.t_in).normalized();
  way.change("grasper", at.t_out + kPassBefore_m * at.t_way, at.t_way);
  way.go(place(length + 0.002), kPassNear_m_per_s);
  way.stay(kPassTaken_s);
  way.go(place(at.t_way.dot(end - at.t_in)), kPassNear_m_per_s);
  way.jaw(1);
  way.jaw(0);
  way.go(place(length + kGrasperOut_m), kPassNear_m_per_s);
  way.jaw(1);
  way.jaw(0);
  way.go(place(length + kPassBefore_m), kPassCarry_m_per_s);
}

void draw_graft(PlacingHandWay& way, const PlacesNow& at, double drawn_m) {
  const auto place = [&](double m) { return held_by_shaft(at.f_out + m * at.f_way, at.f_way); };
  way.change("clamp", at.f_out + kPassBefore_m * at.f_way, at.f_way);
  way.jaw(1);
  way.go(place(kPassThread_m), kPassNear_m_per_s);
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
  const Vec3 middle = 0.5 * (at.f_in + at.t_in);
  const double pace = skill.travel_m_per_s / Skill{}.travel_m_per_s;
  PlacingHandWay way("passing_pin", held_by_shaft(at.f_in - kPassBefore_m * at.f_way, -at.f_way),
                     middle, pace);
  way.stay(0.3);
  const bool too_far = *fault == "lost_thread";
  pass_pin(way, at, plan->femur.length_m() + (too_far ? kPinTooFar_m : kPinBeyond_m));
  fetch_thread(way, at);
  draw_graft(way, at, drawn_by(*fault, plan->button_out_m()));
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
  way.go_at(held_by_shaft(portal_W + deep * in, -in), kPassNear_m_per_s);
  way.stay(1);
  return way.path();
}

}  // namespace osteon
