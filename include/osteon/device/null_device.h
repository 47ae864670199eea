#pragma once

#include "osteon/device/haptic_device.h"

namespace osteon {

/// Nobody holds anything: rests at the origin and takes every force without effect.
class NullDevice : public HapticDevice {
 public:
  NullDevice();
  const DeviceInfo& info() const override { return info_; }
  DeviceSample read() override;
  void write_force(const Vec3& force_V) override;
  void close() override { open_ = false; }

 private:
  DeviceInfo info_;
  std::int64_t time_ns_ = 0;
  bool open_ = true;
};

}  // namespace osteon
