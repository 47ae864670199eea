#pragma once

#include "osteon/device/haptic_device.h"
#include "osteon/device/passivity.h"
#include "osteon/device/safety_limits.h"

namespace osteon {

/// Stages 3 to 5 of the safety gate for a torque: passivity, slew, peak and lasting torque, each
/// with the device's own limits for its driven rotations. Passivity counts a torque as the force
/// that it is at a lever of 50 mm, a stylus' length: work and power are the same. Plain arithmetic
/// on its own state; not finite is the gate's matter.
class TorqueStages {
 public:
  static constexpr double kLever_m = 0.05;

  TorqueStages(const DeviceInfo& info, const PassivityParams& passivity, double thermal_s);
  /// Some rotation has a motor. Without, all torques are zero.
  bool driven() const { return info_.drives_rotation(); }
  void restart();
  /// Torque that the limits leave of `torque_V`, N m, in V, after `dt_s`.
  Vec3 shaped(const Vec3& torque_V, const DeviceSample& sample, double dt_s);
  /// What really went to the motors, for `dt_s`.
  void spend(const Vec3& torque_V, double dt_s);
  double limit_nm() const { return driven() ? budget_.limit_n() : 0; }
  double heat() const { return budget_.heat(); }

 private:
  Vec3 actuated(const Vec3& torque_V) const;
  Vec3 turned(const Quat& q_VD);

  DeviceInfo info_;
  PassivityControl passivity_;
  SlewLimit slew_;      ///< of N m
  ForceBudget budget_;  ///< of N m
  Quat last_q_VD_ = Quat::Identity();
  Vec3 turned_V_ = Vec3::Zero();  ///< the hand's rotation since the restart, rad
  bool seen_ = false;
};

}  // namespace osteon
