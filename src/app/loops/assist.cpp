#include "loops/assist.h"

#include "osteon/device/safety_limits.h"

namespace osteon {
namespace {

constexpr double kSlow_m_per_s = 0.010;  // below this friction is made up for in part only
constexpr double kSmooth_s = 0.010;      // a sensor's velocity is too rough to be derived

}  // namespace

Vec3 Assist::force(const Vec3& v_V, double dt_s) {
  if (friction_n_ <= 0 && inertia_kg_ <= 0) return Vec3::Zero();
  if (!is_finite(v_V) || !(dt_s > 0)) return Vec3::Zero();
  if (!started_) v_V_ = v_V;
  started_ = true;
  const double share = dt_s / (kSmooth_s + dt_s);
  const Vec3 step = share * (v_V - v_V_);
  v_V_ += step;
  a_V_ += share * (step / dt_s - a_V_);
  const double speed = v_V_.norm();
  const Vec3 friction = friction_n_ * v_V_ / (speed > kSlow_m_per_s ? speed : kSlow_m_per_s);
  return clamped_norm(friction + inertia_kg_ * a_V_, kMost_n);
}

}  // namespace osteon
