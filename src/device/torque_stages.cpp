#include "osteon/device/torque_stages.h"

#include <algorithm>
#include <cmath>

namespace osteon {
namespace {

// Rotation from one turn to the next, as a vector along its axis, rad: 2 atan2(|v|, w), with the
// shorter of both ways round.
Vec3 turn_between(const Quat& from, const Quat& to) {
  Quat d = to * from.conjugate();
  if (d.w() < 0) d.coeffs() = -d.coeffs();
  const double sine = d.vec().norm();
  if (sine < 1e-12) return 2 * d.vec();
  return (2 * std::atan2(sine, d.w()) / sine) * d.vec();
}

}  // namespace

TorqueStages::TorqueStages(const DeviceInfo& info, const PassivityParams& passivity,
                           double thermal_s)
    : info_(info),
      passivity_(passivity),
      slew_(info.max_torque_slew_nm_per_s),
      budget_(info.peak_torque_nm, info.continuous_torque_nm, thermal_s) {}

void TorqueStages::restart() {
  slew_.settle(Vec3::Zero());
  passivity_.restart();
  turned_V_.setZero();
  seen_ = false;
}

// A rotation without a motor must eat neither the slew limit nor the peak of the others.
Vec3 TorqueStages::actuated(const Vec3& torque_V) const {
  Vec3 t = torque_V;
  for (int i = 0; i < 3; ++i)
    if (!info_.torque_axes[static_cast<std::size_t>(i)]) t[i] = 0;
  return t;
}

Vec3 TorqueStages::turned(const Quat& q_VD) {
  if (seen_) turned_V_ += turn_between(last_q_VD_, q_VD);
  seen_ = true;
  last_q_VD_ = q_VD;
  return turned_V_;
}

Vec3 TorqueStages::shaped(const Vec3& torque_V, const DeviceSample& sample, double dt_s) {
  if (!driven()) return Vec3::Zero();
  const Vec3 passive = kLever_m * passivity_.control(actuated(torque_V) / kLever_m,
                                                     kLever_m * actuated(turned(sample.X_VD.q)),
                                                     kLever_m * actuated(sample.w_V), dt_s);
  const Vec3 torque = budget_.limited(slew_.next(passive, dt_s));
  slew_.settle(torque);
  return torque;
}

void TorqueStages::spend(const Vec3& torque_V, double dt_s) {
  if (!driven()) return;
  passivity_.delivered(torque_V / kLever_m);
  budget_.spend(torque_V, dt_s);
}

}  // namespace osteon
