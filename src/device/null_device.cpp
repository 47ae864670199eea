#include "osteon/device/null_device.h"

#include "period.h"

namespace osteon {

NullDevice::NullDevice() {
  info_.name = "No device";
  info_.driver = "null";
  info_.force_axes = {false, false, false};
}

DeviceSample NullDevice::read() {
  time_ns_ += to_ns(period_s(info_));
  DeviceSample sample;
  sample.time_ns = time_ns_;
  sample.connected = open_;
  return sample;
}

// There are no motors to take it.
void NullDevice::write_force(const Vec3&) {}

}  // namespace osteon
