#pragma once

#include "osteon/base/latest_value.h"
#include "osteon/device/haptic_device.h"

namespace osteon {

/// Sticks of a gamepad, each in [-1, 1]; the window's thread reads them (GLFW belongs to the app).
struct PadAxes {
  Vec3 move_V = Vec3::Zero();  ///< x right, y up, z towards the user
  Vec3 turn_V = Vec3::Zero();  ///< about the same axes
  std::uint32_t buttons = 0;
  bool connected = true;
};

/// Sticks with the part of each that counts as rest cut out and what is left stretched back to
/// [-1, 1]. A stick that is not finite counts as released. `dead_zone` in [0, 1).
Vec3 past_dead_zone(const Vec3& sticks, double dead_zone);

struct PadParams {
  double speed_m_per_s = 0.05;       ///< at full stick
  double turn_rate_rad_per_s = 1.5;  ///< at full stick
  double dead_zone = 0.12;           ///< share of the stick's way that counts as rest
};

/// A gamepad as a device without motors: the sticks set the stylus's velocity, which each `read`
/// integrates over one period of the profile's rate, kept inside the workspace.
class PadDevice : public HapticDevice {
 public:
  explicit PadDevice(const DeviceInfo& info, const PadParams& params = {});
  /// From the window's thread. A stick that is not finite counts as released.
  void set_axes(const PadAxes& axes);

  const DeviceInfo& info() const override { return info_; }
  DeviceSample read() override;
  void write_force(const Vec3& force_V) override;
  void close() override { open_ = false; }

 private:
  DeviceInfo info_;
  PadParams params_;
  LatestValue<PadAxes> axes_;
  Pose X_VD_;
  std::int64_t time_ns_ = 0;
  bool open_ = true;
};

}  // namespace osteon
