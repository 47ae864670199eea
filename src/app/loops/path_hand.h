#pragma once

#include "osteon/device/haptic_device.h"
#include "osteon/device/virtual_hand.h"
#include "osteon/scene/path.h"

namespace osteon {

/// The virtual hand that follows a probe path over and over, and yields to the force: a
/// demonstration in the closed loop. Its frame V is World; each `read` advances it by one period of
/// its rate.
class PathHand : public HapticDevice {
 public:
  /// `path` must not be empty.
  PathHand(ProbePath path, const DeviceInfo& info, const HandParams& hand = {});
  const DeviceInfo& info() const override { return info_; }
  DeviceSample read() override;
  void write_force(const Vec3& force_V) override;
  void close() override { force_V_.setZero(); }

 private:
  DeviceInfo info_;
  ProbePath path_;
  VirtualHand hand_;
  double period_s_;
  std::uint64_t ticks_ = 0;
  Vec3 force_V_ = Vec3::Zero();
};

/// `path` with a calm way back to its start, so that it can be repeated without a jump.
ProbePath closed_path(ProbePath path, double return_speed_m_per_s = 0.05);

}  // namespace osteon
