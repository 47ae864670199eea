#include "acl_drilling.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <optional>
#include <string>

#include "acl_way.h"

namespace osteon {
namespace {

using Kind = AclMove::Kind;

constexpr double kStand_m = 0.1, kNear_m = 0.012, kTouch_m = 0.004;
constexpr double kFast_m_per_s = 0.25, kSlow_m_per_s = 0.04, kPull_m_per_s = 0.03;
constexpr double kPinOut_m = 0.004;     // a pin stands out of the far side so far
constexpr double kTibiaOut_m = 0.0065;  // of a drill of 8 mm, until its slanted rim is clear
constexpr double kFemurOut_m = 0.005;
constexpr double kPlunge_m = 0.016, kShortSocket_m = 0.0185, kFreeHand_m = 0.007;
constexpr double kChannelLeft_m = 0.0075, kLeastSocket_m = 0.0215;
constexpr double kDrive_n = 3, kGently_n = 2, kLongest_s = 60;
constexpr double kLean_n = 1, kLongestLean_s = 6;

// The tibial aimer's line stands so far from its shaft.
constexpr double kAimerTurn_rad = 55 * kAclTurn;
constexpr double kAimerTip_m = 0.0011;  // radius of what touches the plateau
constexpr double kAimerPress_m = 0.0025;

// How an aimer stands on the bone: its tip, its shaft, and the way by which it comes.
struct AimerStand {
  Pose X_WT;
  Vec3 back_W = Vec3::UnitZ();  // along its shaft
  Vec3 out_W = Vec3::UnitZ();   // of the bone
  bool leans = false;           // on slanted bone, where it would slide off when it is pressed
};

Pose standing(const Vec3& p_W, const Vec3& z_W, const Vec3& towards_x_W) {
  const Vec3 x = (towards_x_W - towards_x_W.dot(z_W) * z_W).normalized();
  Mat3 R;
  R << x, z_W.cross(x), z_W;
  return {p_W, Quat(Eigen::Quaterniond(R)).normalized()};
}

// The tip on the plateau in the line, the shaft out of the joint as near to the portal as the
// aimer's angle lets it.
AimerStand tibial_aimer(const AclKnee& knee, const AclLine& line, double length_m) {
  const Vec3 mouth = line.at_W + length_m * line.in_W, out = -line.in_W;
  const Vec3 up = knee.normal(false, mouth);
  const double rises = std::max(0.3, up.dot(line.in_W));
  const Vec3 tip = mouth + kAimerTip_m / rises * line.in_W;
  const Vec3 portal = (knee.mark("portal_am") - tip).normalized();
  const Vec3 aside = (portal - portal.dot(out) * out).normalized();
  const Vec3 shaft = std::cos(kAimerTurn_rad) * out + std::sin(kAimerTurn_rad) * aside;
  return {standing(tip, shaft, out), shaft, up};
}

// Points of the hook of the femoral aimer and of what bears it, in Tool.
std::vector<Vec3> hook_points(double offset_m) {
  std::vector<Vec3> points;
  const double x = offset_m + 0.0016;
  for (const double y : {-0.0026, 0.0, 0.0026}) {
    for (const double dx : {-0.0012, 0.0, 0.0012})
      for (const double z : {-0.001, 0.003, 0.007}) points.emplace_back(x + dx, y, z);
    for (const double share : {-0.3, 0.0, 0.4, 0.8, 1.3})
      for (const double z : {0.0065, 0.0095}) points.emplace_back(share * x, y, z);
  }
  return points;
}

// How far before a place on the wall the hook meets the femur; none: it meets another bone, or
// bone on its way.
std::optional<double> hook_meets(const AclKnee& knee, const AclLine& line, const Pose& X,
                                 double offset_m) {
  constexpr double kWay_m = 0.06, kStride_m = 0.00025, kRoom_m = 0.0005, kLeast_m = -0.004;
  const auto points = hook_points(offset_m);
  for (double before = kWay_m; before > kLeast_m;) {
    double room = kWay_m;
    for (const Vec3& p : points) {
      const Vec3 p_W = X * p - before * line.in_W;
      if (knee.tibia_m(p_W) < kRoom_m) return std::nullopt;
      room = std::min(room, knee.femur_m(p_W));
    }
    if (room <= 0) return before;
    before -= std::max(kStride_m, 0.5 * room);
  }
  return std::nullopt;
}

// The hook over the back edge where it fits there, else turned to where it does: it must meet the
// bone while the sleeve is before the wall.
AimerStand femoral_aimer(const AclKnee& knee, const AclLine& line) {
  constexpr double kOffset_m = 0.004, kWanted_m = 0.002;
  const Vec3 back = -line.in_W;
  const Vec3 hind = knee.mark("blumensaat_posterior") - knee.mark("blumensaat_anterior");
  AimerStand best;
  double least = 1e9;
  for (int k = 0; k < 24; ++k) {
    const Vec3 towards =
        Quat(Eigen::AngleAxisd(15 * k * kAclTurn, back)) * Vec3(hind - hind.dot(back) * back);
    const Pose X = standing(line.at_W, back, towards);
    const auto before = hook_meets(knee, line, X, kOffset_m);
    if (!before) continue;
    const double off = std::abs(*before - kWanted_m) + 0.0002 * std::min(k, 24 - k);
    if (!(off < least)) continue;
    least = off;
    best = {{line.at_W - *before * line.in_W, X.q}, back, back, true};
  }
  return best;
}

// How far beyond the middle of its mouth a drill must go until the mouth is round: the more, the
// flatter the line comes out.
double rim_clear_m(const AclKnee& knee, const AclDrillPlan& plan, double tibia_m) {
  constexpr double kMost_m = 0.0095;
  const Vec3 up = knee.normal(false, plan.tibia.at_W + tibia_m * plan.tibia.in_W);
  const double straight = std::clamp(std::abs(up.dot(plan.tibia.in_W)), 0.2, 1.0);
  const double radius = 0.5 * plan.reamed_m, rim = 0.5 * radius;
  const double slanted = radius * std::sqrt(1 - straight * straight) / straight;
  return std::clamp(slanted + rim, kTibiaOut_m, kMost_m);
}

std::string drill_of(double size_m) {
  char text[40];
  std::snprintf(text, sizeof text, "cannulated_drill:%g", 1e3 * size_m);
  return text;
}

// Straight into the tibia below where the tunnel begins: without a pin a drill slides off
// elsewhere.
AclLine free_hand_line(const AclKnee& knee, const AclLine& line) {
  constexpr double kBelow_m = 0.016, kNearest_m = 0.0001;
  Vec3 at = line.at_W + kBelow_m * knee.tibial(Vec3(1, 0, 0));
  for (int i = 0; i < 8 && std::abs(knee.tibia_m(at)) > kNearest_m; ++i)
    at -= knee.tibia_m(at) * knee.normal(false, at);
  return {at, -knee.normal(false, at)};
}

// Writes moves along one line.
class LineMoves {
 public:
  LineMoves(const AclLine& line, double pace, std::vector<AclMove>& out)
      : line_(line), pace_(pace), out_(out) {}
  Pose at(double deep_m) const {
    return held_by_shaft(line_.at_W + deep_m * line_.in_W, -line_.in_W);
  }
  void go(double deep_m, double m_per_s) {
    out_.push_back({Kind::kGo, at(deep_m), m_per_s * pace_});
  }
  void press(double deep_m, double force_n, bool exact = false) {
    out_.push_back({Kind::kPress, at(deep_m), 0.02, force_n, kLongest_s, {}, exact});
  }
  void take(const std::string& instrument) {
    out_.push_back({Kind::kTake, {}, 0, 0, 0, instrument});
  }
  void power(double share) { out_.push_back({Kind::kPower, {}, 0, 0, share}); }
  void jaw(double share) { out_.push_back({Kind::kJaw, {}, 0, 0, share}); }
  // Fixes a sleeve by which a pin comes to this line.
  void aim(const std::string& aimer, const AimerStand& stand) {
    const auto to = [&](const Vec3& off_W, double m_per_s) {
      out_.push_back({Kind::kGo, {stand.X_WT.p + off_W, stand.X_WT.q}, m_per_s * pace_});
    };
    to(0.25 * stand.back_W, kFast_m_per_s);
    take(aimer);
    jaw(1);
    to(kNear_m * stand.back_W, kSlow_m_per_s);
    if (stand.leans) {
      out_.push_back(
          {Kind::kLean, stand.X_WT, 0.01, kLean_n, kLongestLean_s, {}, false, stand.out_W});
    } else {
      to(Vec3::Zero(), 0.01);
      to(-kAimerPress_m * stand.out_W, 0.01);
    }
    jaw(0);
    if (!stand.leans) to(Vec3::Zero(), 0.01);
    to(0.15 * stand.back_W, kSlow_m_per_s);
  }
  // Takes an instrument out of the bone's way, and comes along the line to before its mouth.
  void come_with(const std::string& instrument) {
    go(-kStand_m, kFast_m_per_s);
    take(instrument);
    go(-kNear_m, kSlow_m_per_s);
    go(-kTouch_m, kSlow_m_per_s);
  }
  // Leaves a pin where it is, and comes with what goes over it: an open chuck slides off the pin,
  // and is shut again where there is no pin beside it.
  void leave_for(const std::string& instrument) {
    jaw(1);
    go(-kStand_m, kSlow_m_per_s);
    take(instrument);
    jaw(0);
    go(-kNear_m, kSlow_m_per_s);
    go(-kTouch_m, kSlow_m_per_s);
  }
  // Drills on until the tip is so deep, and draws the tool back out.
  void drill(double deep_m, double force_n, bool exact = false) {
    power(1);
    press(deep_m, force_n, exact);
  }
  void draw_out() {
    power(0);
    go(-kNear_m, kPull_m_per_s);
  }

 private:
  AclLine line_;
  double pace_;
  std::vector<AclMove>& out_;
};

double through_m(const AclKnee& knee, bool of_femur, const AclLine& line) {
  return knee.way_out(of_femur, line.at_W + 0.001 * line.in_W, line.in_W) + 0.001;
}

// Where a hand waits that drills nothing.
AclLine idle_line(const AclKnee& knee) {
  constexpr double kBefore_m = 0.2;
  const Vec3 portal = knee.mark("portal_am");
  const Vec3 in = (knee.mark("acl_tibia") - portal).normalized();
  return {portal - kBefore_m * in, in};
}

void drill_tibia(const AclKnee& knee, const AclDrillPlan& plan, std::string_view fault, double pace,
                 std::vector<AclMove>& moves) {
  LineMoves tibia(plan.tibia, pace, moves);
  const double tibia_m = through_m(knee, false, plan.tibia);
  if (fault == "no_pin") {
    LineMoves beside(free_hand_line(knee, plan.tibia), pace, moves);
    beside.come_with(drill_of(plan.reamed_m));
    beside.drill(kFreeHand_m, kDrive_n);
    beside.draw_out();
    beside.go(-kStand_m, kSlow_m_per_s);
  }
  tibia.aim(kAclTibialAimer, tibial_aimer(knee, plan.tibia, tibia_m));
  tibia.come_with(kAclPin);
  tibia.drill(tibia_m + kPinOut_m, kDrive_n);
  tibia.power(0);
  tibia.leave_for(drill_of(plan.reamed_m));
  tibia.drill(tibia_m - 0.003, kDrive_n);
  tibia.press(tibia_m + (fault == "plunged" ? kPlunge_m : rim_clear_m(knee, plan, tibia_m)),
              kGently_n);
  tibia.draw_out();
  tibia.take(kAclPin);
  tibia.go(-kStand_m, kSlow_m_per_s);
}

void drill_femur(const AclKnee& knee, const AclDrillPlan& plan, std::string_view fault, double pace,
                 std::vector<AclMove>& moves) {
  LineMoves femur(plan.femur, pace, moves);
  const double femur_m = through_m(knee, true, plan.femur);
  // A channel is left beyond the socket's bottom.
  const double socket_m =
      std::clamp(femur_m - kChannelLeft_m, std::min(kLeastSocket_m, plan.socket_m), plan.socket_m);
  femur.aim(kAclFemoralAimer, femoral_aimer(knee, plan.femur));
  femur.come_with(kAclPin);
  femur.drill(femur_m + kPinOut_m, kDrive_n);
  femur.power(0);
  femur.leave_for(drill_of(plan.channel_m));
  femur.drill(femur_m + kFemurOut_m, kDrive_n);
  femur.draw_out();
  femur.come_with(drill_of(plan.reamed_m));
  femur.drill(fault == "short_socket" ? kShortSocket_m : socket_m, kDrive_n, true);
  femur.draw_out();
  femur.take(kAclPin);
  femur.go(-kStand_m, kSlow_m_per_s);
}

}  // namespace

std::vector<AclMove> drill_both(const AclKnee& knee, const AclDrillPlan& plan,
                                std::string_view fault, double begin_s, double pace) {
  std::vector<AclMove> moves;
  const AclLine first = plan.drills_tibia   ? plan.tibia
                        : plan.drills_femur ? plan.femur
                                            : idle_line(knee);
  LineMoves(first, pace, moves).go(-kStand_m, kFast_m_per_s);
  moves.push_back({Kind::kWait, {}, 0, 0, begin_s});
  if (plan.drills_tibia) drill_tibia(knee, plan, fault, pace, moves);
  if (plan.drills_femur) drill_femur(knee, plan, fault, pace, moves);
  return moves;
}

}  // namespace osteon
