#pragma once

#include <cstdint>

#include "osteon/base/types.h"
#include "osteon/device/haptic_device.h"

namespace osteon {

/// Impedance of the emulated user's hand and grip, with the ranges seen in people.
struct HandParams {
  double mass_kg = 0.15;                ///< 0.05-0.5: stylus and fingers
  double grip_stiffness_n_per_m = 500;  ///< 50-1500: pull towards the wanted position
  double grip_damping_n_s_per_m = 12;   ///< 2-30
};

/// The emulated user: a mass pulled by a spring and a damper towards a wanted pose that a path
/// gives, and yielding to the device's force. Turns freely: its rotation is the wanted one. A
/// function of its inputs. Semi-implicit Euler with the damper taken implicitly, so that it is
/// stable for every damping; the grip needs dt < 2 sqrt(mass / stiffness).
class VirtualHand {
 public:
  explicit VirtualHand(const HandParams& params = {});
  void reset(const Pose& X_WD);
  /// Advances by `dt_s` towards `wanted_WD` (moving at `wanted_v_W`) under `force_W` from the
  /// device. A force that is not finite counts as zero; a step with a time or a wanted pose that is
  /// not finite, or a time not above zero, changes nothing.
  void step(double dt_s, const Pose& wanted_WD, const Vec3& wanted_v_W, const Vec3& force_W);
  const Pose& pose() const { return X_WD_; }
  const Vec3& velocity() const { return v_W_; }
  const Vec3& angular_velocity() const { return w_W_; }
  /// Kinetic energy plus the grip spring's, J.
  double energy(const Pose& wanted_WD) const;

 private:
  HandParams params_;
  Pose X_WD_;
  Vec3 v_W_ = Vec3::Zero();
  Vec3 w_W_ = Vec3::Zero();
};

}  // namespace osteon
