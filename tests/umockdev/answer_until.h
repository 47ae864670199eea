#pragma once

#include <cstdint>

#include "osteon/base/clock.h"
#include "osteon/device/haptic_device.h"

namespace osteon::testing {

/// Reads into `sample` and answers with this force until `done`; false: not within `limit_s`.
template <class Done>
bool answer_until(HapticDevice& device, const Vec3& force_V, int limit_s, DeviceSample& sample,
                  Done done) {
  const std::int64_t end_ns = steady_now_ns() + limit_s * std::int64_t{1'000'000'000};
  do {
    sample = device.read();
    device.write_force(force_V);
  } while (!done() && steady_now_ns() < end_ns);
  return done();
}

}  // namespace osteon::testing
