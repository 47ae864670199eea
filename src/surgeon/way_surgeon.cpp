#include "osteon/surgeon/way_surgeon.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "osteon/base/random.h"
#include "osteon/base/turn.h"

namespace osteon {
namespace {

constexpr double kTurn_rad = 2 * std::numbers::pi;
constexpr double kWayStray = 0.04;  // of a novice's detour: how far beside the way
// Who sees that the tip lags behind what is meant leads it on: by what the force bends the grip.
constexpr double kGripBends_m_per_n = 1.0 / 500, kMostLead_m = 0.0012, kLeadLag_s = 0.15;

}  // namespace

Quat level_jaws(const Vec3& back_W) {
  Vec3 x_W = Vec3::UnitZ().cross(back_W);
  x_W = x_W.norm() > 1e-9 ? Vec3(x_W.normalized()) : Vec3(Vec3::UnitX());
  Mat3 R_WT;
  R_WT << x_W, back_W.cross(x_W), back_W;
  return Quat(Eigen::Quaterniond(R_WT));
}

WaySurgeon::WaySurgeon(std::vector<WayLeg> way, const Skill& skill, const Vec3& portal_W)
    : way_(std::move(way)), skill_(skill), portal_W_(portal_W) {
  Random random(skill.seed + 2);
  for (double& phase : phases_) phase = random.uniform(0, kTurn_rad);
  if (way_.empty()) return;
  tip_W_ = seen_tip_W_ = way_.front().to_W;
  pose_ = through_portal(tip_W_);
  begin_leg();
}

Pose WaySurgeon::through_portal(const Vec3& tip_W) const {
  const Vec3 back = (portal_W_ - tip_W).normalized();
  if (!way_.empty() && way_.front().level) return {tip_W, level_jaws(back)};
  return {tip_W, turn_between(Vec3::UnitZ(), back)};
}

void WaySurgeon::begin_leg() {
  there_ = false;
  waited_s_ = 0;
  if (at_ >= way_.size()) return;
  const WayLeg& leg = way_[at_];
  if (leg.power) commands_.push_back({CommandKind::kPower, *leg.power});
  if (leg.jaw) commands_.push_back({CommandKind::kJaw, *leg.jaw});
}

Command WaySurgeon::command() {
  if (commands_.empty()) return {};
  const Command next = commands_.front();
  commands_.pop_front();
  return next;
}

void WaySurgeon::move(double dt_s) {
  const WayLeg& leg = way_[at_];
  if (!there_) {
    const Vec3 rest = leg.to_W - tip_W_;
    const double step = leg.m_per_s * dt_s;
    there_ = rest.norm() <= step || (leg.press_n > 0 && known_W_.norm() >= leg.press_n);
    if (rest.norm() <= step)
      tip_W_ = leg.to_W;
    else if (!there_)
      tip_W_ += rest * (step / rest.norm());
    return;
  }
  waited_s_ += dt_s;
  const double think_s = leg.place ? skill_.think_s : 0;
  if (waited_s_ < leg.wait_s + think_s) return;
  if (leg.place) ++places_;
  ++at_;
  begin_leg();
}

// Who is not sure of hand goes beside the way, in slow waves.
Vec3 WaySurgeon::strayed_W() const {
  Vec3 tip_W = tip_W_;
  for (std::size_t k = 0; k < 3; ++k)
    tip_W[static_cast<Eigen::Index>(k)] +=
        kWayStray * skill_.detour_m *
        std::sin(kTurn_rad * (0.31 + 0.13 * static_cast<double>(k)) * time_s_ + phases_[6 + k]);
  return tip_W;
}

Pose WaySurgeon::step(double dt_s) {
  dt_s_ = dt_s;
  time_s_ += dt_s;
  if (!done()) move(dt_s);
  const bool leans = !done() && way_[at_].leans;
  if (!leans) seen_tip_W_ = tip_W_;
  Vec3 lead = leans ? Vec3(Vec3::Zero()) : Vec3(-kGripBends_m_per_n * known_W_);
  if (lead.norm() > kMostLead_m) lead *= kMostLead_m / lead.norm();
  lead_W_ += (lead - lead_W_) * std::min(1.0, dt_s / kLeadLag_s);
  pose_ = through_portal(strayed_W() + lead_W_);
  for (std::size_t k = 0; k < 6; ++k)
    pose_.p[static_cast<Eigen::Index>(k % 3)] +=
        0.5 * skill_.tremor_m * std::sin(kTurn_rad * (k < 3 ? 8.3 : 10.7) * time_s_ + phases_[k]);
  return pose_;
}

void WaySurgeon::feel(const Vec3& force_W) {
  felt_W_.push_back(is_finite(force_W) ? force_W : Vec3(Vec3::Zero()));
  if (felt_W_.size() <= static_cast<std::size_t>(skill_.delay_s / dt_s_)) return;
  known_W_ = felt_W_.front();
  felt_W_.pop_front();
}

}  // namespace osteon
