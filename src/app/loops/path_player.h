#pragma once

#include <memory>

#include "loops/device_mapping.h"
#include "osteon/base/result.h"
#include "osteon/device/emulated_user.h"
#include "osteon/device/haptic_device.h"
#include "osteon/scene/path.h"

namespace osteon {

/// A device whose emulated user follows a probe path, over and over. Its frame V is World: the
/// path's middle is the middle of the device, its first turn the device's own, and a path that is
/// wider than the workspace is drawn together to it. Each `read` is one period of the rate.
class PathPlayer : public HapticDevice {
 public:
  /// Brings the hand to the path's start. `path` must not be empty. Fails when the device's user is
  /// a real one, or when it does not get there.
  static Result<std::unique_ptr<PathPlayer>> make(std::unique_ptr<HapticDevice> device,
                                                  ProbePath path);
  const DeviceInfo& info() const override { return device_->info(); }
  DeviceSample read() override;
  /// A read with the hand kept at the path's start.
  DeviceSample read_at_start();
  void write_force(const Vec3& force_W) override;
  void write_torque(const Vec3& torque_W) override {
    device_->write_torque(mapping_.force_to_device(torque_W));
  }
  void close() override { device_->close(); }
  DeviceHealth health() const override { return device_->health(); }
  void calibrate() override { device_->calibrate(); }

  /// World lengths for one of the device's: 1, or more where the path had to be drawn together.
  double scale() const { return mapping_.scale; }

 private:
  PathPlayer(std::unique_ptr<HapticDevice> device, EmulatedUser& user, ProbePath path);
  Result<void> go_to_start();
  DeviceSample to_world(const DeviceSample& sample_V) const;

  std::unique_ptr<HapticDevice> device_;
  EmulatedUser& user_;
  ProbePath path_;
  DeviceMapping mapping_;
  double period_s_;
  std::uint64_t ticks_ = 0;
};

}  // namespace osteon
