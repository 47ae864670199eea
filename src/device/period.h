#pragma once

#include <cmath>
#include <cstdint>

#include "osteon/device/haptic_device.h"

namespace osteon {

/// One period of the device's rate, s; 1 ms for a rate that makes no sense.
inline double period_s(const DeviceInfo& info) {
  return info.rate_hz > 0 && std::isfinite(info.rate_hz) ? 1 / info.rate_hz : 0.001;
}

inline std::int64_t to_ns(double s) { return std::llround(s * 1e9); }

}  // namespace osteon
