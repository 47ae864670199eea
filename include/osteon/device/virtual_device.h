#pragma once

#include "osteon/base/latest_value.h"
#include "osteon/device/emulated_user.h"
#include "osteon/device/haptic_device.h"
#include "osteon/device/virtual_hand.h"

namespace osteon {

/// The virtual hand behind the interface of a device: follows the target and yields to the force.
/// Its clock is virtual: each `read` advances it by one period of the profile's rate. `set_target`
/// may be called by one other thread.
class VirtualDevice : public HapticDevice, public EmulatedUser {
 public:
  explicit VirtualDevice(const DeviceInfo& info, const HandParams& hand = {});
  void set_target(const Pose& wanted_VD, const Vec3& wanted_v_V, std::uint32_t buttons) override;

  const DeviceInfo& info() const override { return info_; }
  DeviceSample read() override;
  void write_force(const Vec3& force_V) override;
  void write_torque(const Vec3& torque_V) override { wanted_torque_V_ = torque_V; }
  void close() override;
  const VirtualHand& hand() const { return hand_; }
  /// That went out with the last force. The emulated hand holds its turn against any.
  const Vec3& torque_V() const { return torque_V_; }

 private:
  struct Target {
    Pose X_VD;
    Vec3 v_V = Vec3::Zero();
    std::uint32_t buttons = 0;
  };
  DeviceInfo info_;
  VirtualHand hand_;
  LatestValue<Target> target_;
  Vec3 force_V_ = Vec3::Zero();
  Vec3 wanted_torque_V_ = Vec3::Zero();  ///< for the next force
  Vec3 torque_V_ = Vec3::Zero();
  std::int64_t time_ns_ = 0;
  bool open_ = true;
};

}  // namespace osteon
