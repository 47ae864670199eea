#include "osteon/device/virtual_hand.h"

#include <cmath>

namespace osteon {
namespace {

// Mean angular velocity that turns q_from into q_to within dt, by the shorter way.
Vec3 mean_angular_velocity(const Quat& q_from, const Quat& q_to, double dt_s) {
  const Quat d = q_to * q_from.conjugate();
  const Vec3 v = d.w() < 0 ? Vec3(-d.vec()) : Vec3(d.vec());
  const double s = v.norm();
  if (s == 0) return Vec3::Zero();
  return v * (2 * std::atan2(s, std::abs(d.w())) / (s * dt_s));
}

}  // namespace

VirtualHand::VirtualHand(const HandParams& params) : params_(params) {}

void VirtualHand::reset(const Pose& X_WD) {
  X_WD_ = X_WD;
  v_W_.setZero();
  w_W_.setZero();
}

void VirtualHand::step(double dt_s, const Pose& wanted_WD, const Vec3& wanted_v_W,
                       const Vec3& force_W) {
  if (!(dt_s > 0) || !std::isfinite(dt_s)) return;
  if (!is_finite(wanted_WD) || !is_finite(wanted_v_W)) return;
  const Vec3 force = is_finite(force_W) ? force_W : Vec3::Zero();
  const double h_m = dt_s / params_.mass_kg;
  const Vec3 pull = params_.grip_stiffness_n_per_m * (wanted_WD.p - X_WD_.p) +
                    params_.grip_damping_n_s_per_m * wanted_v_W + force;
  // The damper acts on the new velocity: m (v' - v) / h = pull - b v'.
  v_W_ = (v_W_ + h_m * pull) / (1 + h_m * params_.grip_damping_n_s_per_m);
  X_WD_.p += dt_s * v_W_;
  w_W_ = mean_angular_velocity(X_WD_.q, wanted_WD.q, dt_s);
  X_WD_.q = wanted_WD.q;
}

double VirtualHand::energy(const Pose& wanted_WD) const {
  const Vec3 stretch = wanted_WD.p - X_WD_.p;
  return 0.5 * params_.mass_kg * v_W_.squaredNorm() +
         0.5 * params_.grip_stiffness_n_per_m * stretch.squaredNorm();
}

}  // namespace osteon
