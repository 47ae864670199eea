#pragma once

#include "osteon/base/latest_value.h"
#include "osteon/device/virtual_hand.h"

namespace osteon {

/// The moving part of an emulated joystick: a mass in the emulated user's grip that motors push. It
/// moves in steps of 1 ms. The first target places the hand there at rest.
class JoystickMechanics {
 public:
  static constexpr std::int64_t kStep_ns = 1'000'000;

  explicit JoystickMechanics(const HandParams& hand = {}) : hand_(hand) {}
  /// May be called by one other thread.
  void set_target(const Pose& wanted_VD, const Vec3& wanted_v_V, std::uint32_t buttons);
  void set_motors(const Vec3& force_V, const Vec3& torque_V = Vec3::Zero()) {
    force_V_ = force_V;
    torque_V_ = torque_V;
  }
  /// Goes on to that time, in whole steps.
  void advance(std::int64_t now_ns);

  const Vec3& motors() const { return force_V_; }
  /// N m; the emulated user holds the turn against it.
  const Vec3& turning_motors() const { return torque_V_; }
  const VirtualHand& hand() const { return hand_; }
  std::uint32_t buttons() const { return buttons_; }
  /// Rotation about `axis_V` of the hand's pose, rad.
  double turn_about(const Vec3& axis_V) const;

 private:
  struct Target {
    Pose X_VD;
    Vec3 v_V = Vec3::Zero();
    std::uint32_t buttons = 0;
    bool given = false;
  };
  LatestValue<Target> target_;
  VirtualHand hand_;
  Vec3 force_V_ = Vec3::Zero();
  Vec3 torque_V_ = Vec3::Zero();
  std::int64_t time_ns_ = 0;
  std::uint32_t buttons_ = 0;
  bool placed_ = false;
};

}  // namespace osteon
