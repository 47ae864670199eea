#pragma once

#include "osteon/physics/soft_state.h"

namespace osteon {

/// A hand's force on a soft part in one step.
struct TouchNow {
  bool felt = true;  ///< the part can be felt
  double force_n = 0, deep_m = 0;
};

/// What has happened to a touch in a step; values as events have them.
struct TouchNews {
  bool begins = false, over = false, ends = false;
  double since_s = 0, peak_n = 0, deepest_mm = 0;  ///< of one that ends
};

/// Follows a touch by a step. `limit_n`: a force above it is told once, and again after it has
/// fallen to nine tenths.
TouchNews follow_touch(BandTouch& touch, const TouchNow& now, double limit_n, std::uint64_t step,
                       double step_s);

}  // namespace osteon
