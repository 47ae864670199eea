#pragma once

#include "osteon/base/latest_value.h"
#include "osteon/device/haptic_device.h"

namespace osteon {

/// The mouse and the keys as a device without motors. The window's thread sets a target at its own
/// rate; each `read` (one period of the profile's rate) moves the stylus towards it as a critically
/// damped second-order filter does, so that 60 pictures a second become smooth motion at 1 kHz.
class MouseDevice : public HapticDevice {
 public:
  explicit MouseDevice(const DeviceInfo& info, double smoothing_s = 0.020);
  /// From the window's thread: wanted stylus in V. Not finite: ignored.
  void set_target(const Pose& wanted_VD, std::uint32_t buttons);

  const DeviceInfo& info() const override { return info_; }
  DeviceSample read() override;
  void write_force(const Vec3& force_V) override;
  void close() override { open_ = false; }

 private:
  struct Target {
    Pose X_VD;
    std::uint32_t buttons = 0;
  };
  void move_towards(const Pose& wanted_VD, double dt_s);

  DeviceInfo info_;
  double smoothing_s_;
  LatestValue<Target> target_;
  Pose X_VD_;
  Vec3 v_V_ = Vec3::Zero();
  Vec3 w_V_ = Vec3::Zero();
  std::int64_t time_ns_ = 0;
  bool open_ = true;
};

}  // namespace osteon
