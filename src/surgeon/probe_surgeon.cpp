#include "osteon/surgeon/probe_surgeon.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "osteon/base/turn.h"

namespace osteon {
namespace {

constexpr double kTau = 2 * std::numbers::pi;
constexpr double kOverAll_m = 0.010;     // ways go so far over the highest top
constexpr double kGentleZone_m = 0.005;  // above a top: from here at the speed of approach
constexpr double kNoticed_n = 0.15;
constexpr double kTooDeep_m = 0.012;
constexpr double kCorrects_m_per_n_s = 0.004;
constexpr double kLongestTouch_s = 6;
constexpr double kInsideShare = 0.3;  // of the speed outside
constexpr double kTooHard_n = 6.5;
constexpr double kLook_m = 0.028;  // from the window to the tip
constexpr double kLag_s = 0.25;
constexpr double kStray = 0.15;  // of a novice's detour
constexpr double kAway_rad = 65 * std::numbers::pi / 180;

}  // namespace

ProbeSurgeon::ProbeSurgeon(const ScenarioPlan& plan, const Case& the_case, const Skill& skill,
                           const Vec3& portal_W, double tip_radius_m)
    : skill_(skill), portal_W_(portal_W), tip_radius_m_(tip_radius_m), random_(skill.seed) {
  for (double& phase : phases_) phase = random_.uniform(0, kTau);
  for (const auto& goals : plan.goals)
    for (const PlannedRule& goal : goals)
      for (const std::uint32_t bone : goal.bones)
        if (goal.about == SubjectKind::kBone) add_target(the_case.bones[bone]);
  for (const PlannedRule& error : plan.errors)
    if (error.rule.kind == skill.fault) fault_numbers_ = error.rule.numbers;
  if (skill_.fault == "left_out" && !targets_.empty()) targets_.pop_back();
  if (skill_.fault == "pressed_over" && !targets_.empty()) targets_.back().press_n = kTooHard_n;
  if (targets_.empty()) return;
  over_z_m_ += kOverAll_m;
  tip_W_ = hover(targets_[0]);
  pose_ = through_portal(tip_W_);
  enter(Phase::kThink);
}

void ProbeSurgeon::add_target(const Bone& bone) {
  Vec3 top = bone.X_WB.p;
  double highest = -1e9;
  for (const Vec3& v : bone.mesh.vertices) {
    const Vec3 p_W = bone.X_WB * v;
    if (p_W.z() > highest) {
      highest = p_W.z();
      top = p_W;
    }
  }
  over_z_m_ = std::max(over_z_m_, highest);
  const double skips = random_.uniform();
  const double off_n = random_.normal(0, skill_.press_spread_n);
  if (skips >= skill_.skip_share) targets_.push_back({top, std::max(0.6, skill_.press_n + off_n)});
}

void ProbeSurgeon::enter(Phase phase) {
  phase_ = phase;
  phase_s_ = pressed_s_ = 0;
}

// True once it is there.
bool ProbeSurgeon::go_to(const Vec3& goal_W, double metres) {
  const Vec3 rest = goal_W - tip_W_;
  if (rest.norm() <= metres) {
    tip_W_ = goal_W;
    return true;
  }
  tip_W_ += rest * (metres / rest.norm());
  return false;
}

void ProbeSurgeon::press(double dt_s) {
  const double wanted_n = targets_[at_].press_n;
  const double step = std::clamp((wanted_n - known_n_) * kCorrects_m_per_n_s, -0.02, 0.02) * dt_s;
  tip_W_.z() -= step;
  if (known_n_ > 0.7 * wanted_n) pressed_s_ += dt_s;
  if (pressed_s_ >= skill_.dwell_s || phase_s_ > kLongestTouch_s) enter(Phase::kLift);
}

void ProbeSurgeon::lifted() {
  const bool levers = skill_.fault == "off_portal" && !faulted_;
  if (levers) return enter(Phase::kFault);
  ++at_;
  enter(at_ < targets_.size() ? Phase::kThink : Phase::kDone);
}

Pose ProbeSurgeon::through_portal(const Vec3& tip_W) const {
  const Vec3 back = (portal_W_ - tip_W).normalized();
  return {tip_W, turn_between(Vec3::UnitZ(), back)};
}

Pose ProbeSurgeon::step(double dt_s) {
  dt_s_ = dt_s;
  time_s_ += dt_s;
  phase_s_ += dt_s;
  const double inside = kInsideShare * skill_.travel_m_per_s * dt_s;
  double aside_m = 0;
  if (phase_ == Phase::kThink && phase_s_ >= skill_.think_s) enter(Phase::kTravel);
  if (phase_ == Phase::kTravel && go_to(hover(targets_[at_]), inside)) enter(Phase::kLower);
  if (phase_ == Phase::kLower) {
    const double above = tip_W_.z() - targets_[at_].top_W.z() - tip_radius_m_;
    tip_W_.z() -= above < kGentleZone_m ? skill_.approach_m_per_s * dt_s : inside;
    if (known_n_ > kNoticed_n) enter(Phase::kPress);
    if (above < -kTooDeep_m) enter(Phase::kLift);
  }
  if (phase_ == Phase::kPress) press(dt_s);
  if (phase_ == Phase::kLift && go_to(hover(targets_[at_]), inside)) lifted();
  if (phase_ == Phase::kFault) {
    const double stay_s = fault_numbers_.at("for_s") + 0.7;
    const double f = std::clamp(std::min(phase_s_, stay_s + 1 - phase_s_) / 0.5, 0.0, 1.0);
    aside_m = f * 2 * fault_numbers_.at("off_mm") / 1000;
    faulted_ = phase_s_ > stay_s + 1;
    if (faulted_) lifted();
  }
  pose_ = through_portal(tip_W_);
  pose_.p += pose_.rotate(Vec3::UnitX()) * aside_m;
  for (std::size_t k = 0; k < 6; ++k)
    pose_.p[static_cast<Eigen::Index>(k % 3)] +=
        0.5 * skill_.tremor_m * std::sin(kTau * (k < 3 ? 8.3 : 10.7) * time_s_ + phases_[k]);
  return pose_;
}

void ProbeSurgeon::feel(const Vec3& force_W) {
  felt_n_.push_back(is_finite(force_W) ? force_W.norm() : 0);
  if (felt_n_.size() <= static_cast<std::size_t>(skill_.delay_s / dt_s_)) return;
  known_n_ = felt_n_.front();
  felt_n_.pop_front();
}

FollowingScope::FollowingScope(const HandPlayer& probe, const ScenarioPlan& plan,
                               const Skill& skill, const ScopeOptics& optics, const Vec3& portal_W)
    : probe_(&probe),
      skill_(skill),
      optics_(optics),
      portal_W_(portal_W),
      looked_at_W_(probe.tip_W()) {
  Random random(skill.seed + 1);
  for (double& phase : phases_) phase = random.uniform(0, kTau);
  for (const PlannedRule& error : plan.errors)
    if (error.rule.kind == "tip_unseen" && skill.fault == "tip_unseen")
      away_s_ = error.rule.numbers.at("for_s") + 0.7;
  if (const auto pose = pose_for({looked_at_W_, kLook_m, 0}, portal_W_, optics_)) pose_ = *pose;
}

Pose FollowingScope::step(double dt_s) {
  time_s_ += dt_s;
  looked_at_W_ += (probe_->tip_W() - looked_at_W_) * std::min(1.0, dt_s / kLag_s);
  Vec3 at_W = looked_at_W_;
  for (std::size_t k = 0; k < 3; ++k)
    at_W[static_cast<Eigen::Index>(k)] +=
        kStray * skill_.detour_m *
        std::sin(kTau * (0.23 + 0.11 * static_cast<double>(k)) * time_s_ + phases_[k]);
  if (const auto pose = pose_for({at_W, kLook_m, 0}, portal_W_, optics_)) pose_ = *pose;
  if (away_s_ <= 0 || probe_->touched() == 0) return pose_;
  fault_s_ = fault_s_ < 0 ? 0 : fault_s_ + dt_s;
  const double f = std::clamp(std::min(fault_s_, away_s_ + 1 - fault_s_) / 0.5, 0.0, 1.0);
  const Eigen::AngleAxisd away(kAway_rad * f, pose_.rotate(Vec3::UnitX()));
  return {portal_W_ + away * Vec3(pose_.p - portal_W_), Quat(away) * pose_.q};
}

}  // namespace osteon
