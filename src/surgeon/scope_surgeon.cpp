#include "osteon/surgeon/scope_surgeon.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace osteon {
namespace {

constexpr double kTwoPi = 2 * std::numbers::pi;
constexpr double kDegree_rad = std::numbers::pi / 180;
constexpr double kRoomWanted_m = 0.001;
constexpr double kStray_m = 0.0015;
constexpr double kTurnSpeed_rad_per_s = 1.2;
constexpr double kZoomSpeed_m_per_s = 0.02;
constexpr double kLongestHold_s = 20;
constexpr double kStepBack_m = 0.012;    // on the way to the next mark
constexpr double kNextTo_m = 0.008;      // a mark so near is gone to without stepping back
constexpr double kSteerShare = 0.25;     // of a probe's speed: a scope is led slower
constexpr double kWanderShare = 0.1;     // of a detour: how far the aim strays
constexpr double kWanderTurn_rad_m = 4;  // turn that goes with it
constexpr double kPush_m_per_s = 0.03;
constexpr double kPushStop_n = 1.0;     // over the friction of the portal
constexpr double kZoomMore_m = 0.0025;  // beyond a span: what the portal holds back

// From 0 to 1 with speed and acceleration 0 at both ends (minimum jerk: Flash and Hogan 1985).
double smooth(double f) {
  f = std::clamp(f, 0.0, 1.0);
  return f * f * f * (10 + f * (6 * f - 15));
}

}  // namespace

ScopeSurgeon::ScopeSurgeon(const ScenarioPlan& plan, const Case& the_case, const Skill& skill,
                           const Scope& scope)
    : skill_(skill), scope_(scope), random_(skill.seed) {
  for (double& phase : phases_) phase = random_.uniform(0, kTwoPi);
  for (const auto& goals : plan.goals)
    for (const PlannedRule& goal : goals)
      for (const std::uint32_t mark : goal.bones)
        if (goal.about == SubjectKind::kLandmark) add_target(the_case, goal, mark);
  for (const PlannedRule& error : plan.errors)
    if (error.rule.kind == skill.fault) fault_numbers_ = error.rule.numbers;
  if (targets_.empty()) return;
  gaze_ = targets_[0].gaze;
  gaze_.distance_m += kStepBack_m;
  pose_ = posed(gaze_);
  enter(Phase::kThink);
}

void ScopeSurgeon::add_target(const Case& the_case, const PlannedRule& goal, std::uint32_t mark) {
  const auto& n = goal.rule.numbers;
  const double skips = random_.uniform();
  Target target;
  target.gaze.at_W = the_case.landmarks[mark].p_W;
  target.near_m = n.at("near_mm") / 1000;
  target.far_m = n.at("far_mm") / 1000;
  target.central = n.at("central");
  target.for_s = n.at("for_s");
  target.span_m = n.at("span_mm") / 1000;
  target.level_rad = n.at("level_deg") * kDegree_rad;
  if (skips < skill_.skip_share) return;
  if (find_gaze(the_case, target))
    targets_.push_back(target);
  else
    unreachable_.push_back(the_case.landmarks[mark].name);
}

bool ScopeSurgeon::is_clear(const Case& the_case, const Gaze& gaze) const {
  const auto pose = pose_for(gaze, scope_.portal_W, scope_.optics);
  if (!pose) return false;
  return shaft_room_m(the_case, *pose, scope_.portal_W, scope_.radius_m) > kRoomWanted_m &&
         is_in_sight(the_case, pose->p, gaze.at_W);
}

// From every place where the tip may stand: a portal's friction holds it back.
bool ScopeSurgeon::is_in_sight(const Case& the_case, const Vec3& eye_W, const Vec3& at_W) const {
  const BoneSnapshot at_rest;  // of no bones: where each is at rest
  if (is_hidden(the_case, at_rest, eye_W, at_W)) return false;
  for (Eigen::Index k = 0; k < 3; ++k)
    for (const double side : {-kStray_m, kStray_m}) {
      Vec3 strayed_W = eye_W;
      strayed_W[k] += side;
      if (is_hidden(the_case, at_rest, strayed_W, at_W)) return false;
    }
  return true;
}

// The least turn first, then distances from the middle of what is allowed outwards. A span is
// looked at from its two ends as well.
bool ScopeSurgeon::find_gaze(const Case& the_case, Target& target) const {
  const double middle = 0.5 * (target.near_m + target.far_m);
  const double reach = 0.5 * (target.far_m - target.near_m - target.span_m) * 0.8;
  for (int turn = 0; turn <= 12; ++turn)
    for (const double side : {1.0, -1.0}) {
      target.gaze.turn_rad = side * turn * 15 * kDegree_rad;
      if (turn > 0 && std::abs(target.gaze.turn_rad) > 0.7 * target.level_rad) return false;
      for (const double share : {0.0, -0.5, 0.5, -1.0, 1.0}) {
        target.gaze.distance_m = middle + share * reach;
        bool clear = is_clear(the_case, target.gaze);
        for (const double end : {-0.5, 0.5}) {
          Gaze at_end = target.gaze;
          at_end.distance_m += end * (target.span_m + 2 * kZoomMore_m);
          if (target.span_m > 0) clear = clear && is_clear(the_case, at_end);
        }
        if (clear) return true;
      }
    }
  return false;
}

Pose ScopeSurgeon::posed(const Gaze& gaze) const {
  return pose_for(gaze, scope_.portal_W, scope_.optics).value_or(pose_);
}

Pose ScopeSurgeon::start() const { return pose_; }

void ScopeSurgeon::enter(Phase phase) {
  phase_ = phase;
  phase_s_ = right_s_ = 0;
  if (phase == Phase::kTravel) begin_travel();
}

void ScopeSurgeon::begin_travel() {
  from_ = gaze_;
  const Gaze& to = target().gaze;
  const double speed = kSteerShare * skill_.travel_m_per_s;
  travel_s_ = std::max({(to.at_W - from_.at_W).norm() / speed,
                        std::abs(to.distance_m - from_.distance_m) / kZoomSpeed_m_per_s,
                        std::abs(to.turn_rad - from_.turn_rad) / kTurnSpeed_rad_per_s, 0.1}) *
              1.9;  // the fastest moment of a minimum-jerk way is 1.875 of its mean
}

void ScopeSurgeon::travel() {
  const Gaze& to = target().gaze;
  const double f = smooth(phase_s_ / travel_s_);
  const double back = (to.at_W - from_.at_W).norm() > kNextTo_m ? kStepBack_m : 0;
  gaze_.at_W = from_.at_W + f * (to.at_W - from_.at_W);
  gaze_.turn_rad = from_.turn_rad + f * (to.turn_rad - from_.turn_rad);
  gaze_.distance_m =
      from_.distance_m + f * (to.distance_m - from_.distance_m) + 4 * f * (1 - f) * back;
  if (phase_s_ >= travel_s_) enter(Phase::kHold);
}

// Who is not sure of hand looks beside the mark, in slow waves.
Gaze ScopeSurgeon::wandered(Gaze gaze) const {
  const double far = kWanderShare * skill_.detour_m;
  for (Eigen::Index k = 0; k < 3; ++k) {
    const auto wave = static_cast<std::size_t>(k);
    gaze.at_W[k] += far * std::sin(kTwoPi * (0.31 + 0.13 * static_cast<double>(k)) * time_s_ +
                                   phases_[6 + wave]);
  }
  gaze.turn_rad +=
      kWanderTurn_rad_m * skill_.detour_m * std::sin(kTwoPi * 0.17 * time_s_ + phases_[9]);
  return gaze;
}

bool ScopeSurgeon::looks_right(const Gaze& meant) const {
  const ScopeView view = view_through(scope_.optics, pose_);
  const Vec3 way = target().gaze.at_W - view.eye_W;
  const double off = std::acos(std::clamp(way.normalized().dot(view.along_W), -1.0, 1.0));
  return off < 0.95 * target().central * scope_.optics.half_field_rad &&
         std::abs(turn_deg(view)) * kDegree_rad < 0.95 * target().level_rad &&
         meant.distance_m > target().near_m;
}

// Holds until the picture has been right for the time wanted; a span is gone through once, there
// and back.
void ScopeSurgeon::hold(double dt_s) {
  const Target& t = target();
  gaze_ = t.gaze;
  const double wanted_s = 1.1 * t.for_s + 0.05;
  const double zoom_s = t.span_m > 0 ? 2.2 * std::numbers::pi * t.span_m / kZoomSpeed_m_per_s : 0;
  if (zoom_s > 0)
    gaze_.distance_m +=
        (0.5 * t.span_m + kZoomMore_m) * std::sin(kTwoPi * std::min(phase_s_ / zoom_s, 1.0));
  right_s_ = looks_right(gaze_) ? right_s_ + dt_s : 0;
  if (right_s_ < std::max(wanted_s, zoom_s) && phase_s_ < kLongestHold_s + zoom_s) return;
  gaze_ = t.gaze;
  if (!skill_.fault.empty() && !faulted_) return enter(Phase::kFault);
  next_target();
}

void ScopeSurgeon::next_target() {
  if (at_ + 1 >= targets_.size()) return enter(Phase::kDone);
  ++at_;
  enter(Phase::kThink);
}

// Up, stay, down again.
double ScopeSurgeon::fault_share(double ramp_s, double stay_s) const {
  if (phase_s_ < ramp_s) return smooth(phase_s_ / ramp_s);
  return 1 - smooth((phase_s_ - ramp_s - stay_s) / ramp_s);
}

// What is done wrong on purpose: levers out of the portal, turns the picture, looks away, or pushes
// the window onto what is before it.
Pose ScopeSurgeon::faulty(Pose pose, double dt_s) {
  const auto number = [&](const char* name) { return fault_numbers_.at(name); };
  const double stay_s = number("for_s") + 0.7;
  bool over = phase_s_ > 2 * 0.5 + stay_s;
  if (skill_.fault == "off_portal") {
    const double aside_m = 2 * number("off_mm") / 1000;
    pose.p += pose.rotate(Vec3::UnitX()) * (aside_m * fault_share(0.5, stay_s));
  } else if (skill_.fault == "tilted") {
    Gaze turned = gaze_;
    turned.turn_rad += (1.5 * number("level_deg") + 10) * kDegree_rad * fault_share(0.5, stay_s);
    pose = posed(turned);
  } else if (skill_.fault == "nothing_seen") {
    // Upwards, clear of what stands in the box.
    const Vec3 across = pose.rotate(-Vec3::UnitZ()).cross(Vec3::UnitZ()).normalized();
    const Eigen::AngleAxisd away(100 * kDegree_rad * fault_share(0.5, stay_s), across);
    pose = {scope_.portal_W + away * Vec3(pose.p - scope_.portal_W), Quat(away) * pose.q};
  } else {
    if (yielded_s_ < 0 && known_n_ > kPushStop_n) yielded_s_ = phase_s_;
    const bool back = yielded_s_ >= 0 && phase_s_ > yielded_s_ + stay_s;
    if (yielded_s_ < 0 || back) pushed_m_ += (back ? -1 : 1) * kPush_m_per_s * dt_s;
    pose.p -= pose.rotate(Vec3::UnitZ()) * pushed_m_;
    over = back ? pushed_m_ <= 0 : pushed_m_ > 0.1;
  }
  if (over) {
    faulted_ = true;
    next_target();
  }
  return pose;
}

Vec3 ScopeSurgeon::tremor() const {
  Vec3 sum = Vec3::Zero();
  for (std::size_t k = 0; k < 6; ++k)
    sum[static_cast<Eigen::Index>(k % 3)] +=
        0.5 * skill_.tremor_m * std::sin(kTwoPi * (k < 3 ? 8.3 : 10.7) * time_s_ + phases_[k]);
  return sum;
}

Pose ScopeSurgeon::step(double dt_s) {
  dt_s_ = dt_s;
  time_s_ += dt_s;
  phase_s_ += dt_s;
  if (phase_ == Phase::kThink && phase_s_ >= skill_.think_s) enter(Phase::kTravel);
  if (phase_ == Phase::kTravel) travel();
  if (phase_ == Phase::kHold) hold(dt_s);
  pose_ = posed(wandered(gaze_));
  if (phase_ == Phase::kFault) pose_ = faulty(pose_, dt_s);
  pose_.p += tremor();
  return pose_;
}

void ScopeSurgeon::feel(const Vec3& force_W) {
  felt_n_.push_back(is_finite(force_W) ? force_W.norm() : 0);
  const auto late = static_cast<std::size_t>(skill_.delay_s / dt_s_);
  if (felt_n_.size() <= late) return;
  known_n_ = felt_n_.front();
  felt_n_.pop_front();
}

}  // namespace osteon
