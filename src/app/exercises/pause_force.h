#pragma once

#include <optional>

#include "osteon/device/haptic_device.h"

namespace osteon {

/// What a pause of an exercise does to the force: it is off in a pause and comes back as after any
/// other stop. One that was off before, that the user took off meanwhile or that a fault took off
/// stays off.
/// `wanted`: whether the force was wanted as the pause began. Nothing: the force is left as it is.
inline std::optional<bool> force_at_pause(bool begins, bool wanted, ForceOff cause) {
  if (begins) return false;
  return wanted && cause == ForceOff::kSoftware ? std::optional(true) : std::nullopt;
}

}  // namespace osteon
