#pragma once

#include <cstdint>

#include "osteon/base/types.h"

namespace osteon {

/// A device whose user is emulated offers this beside HapticDevice: whoever plays a path sets where
/// that user wants the stylus. May be called by one other thread than the device's.
class EmulatedUser {
 public:
  virtual ~EmulatedUser() = default;
  /// Wanted stylus in the device's frame V, and how fast it moves there, m/s. Not finite: ignored.
  virtual void set_target(const Pose& wanted_VD, const Vec3& wanted_v_V, std::uint32_t buttons) = 0;
};

}  // namespace osteon
