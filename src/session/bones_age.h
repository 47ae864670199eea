#pragma once

#include <algorithm>
#include <cstdint>

#include "osteon/haptic/snapshot_age.h"

namespace osteon {

/// How far the bones of a snapshot must be carried forward at a haptic tick; see Session. A
/// function of which snapshot each tick consumed, so that a replay finds the same.
class BonesAge {
 public:
  /// Ticks come in order.
  double at(std::uint64_t tick, std::uint64_t step, double tick_s) {
    if (step != step_) {
      step_ = step;
      first_tick_ = tick;
    }
    return std::min(static_cast<double>(tick - first_tick_ + 1) * tick_s, kOldestSnapshot_s);
  }
  void restore(std::uint64_t step, std::uint64_t first_tick) {
    step_ = step;
    first_tick_ = first_tick;
  }
  std::uint64_t step() const { return step_; }
  std::uint64_t first_tick() const { return first_tick_; }

 private:
  std::uint64_t step_ = 0;
  std::uint64_t first_tick_ = 1;  // of those that saw this step
};

}  // namespace osteon
