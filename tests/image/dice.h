#pragma once

#include <cstddef>

#include "osteon/image/volume.h"

namespace osteon {

/// Share of agreement 2 |A and B| / (|A| + |B|) (Dice 1945); masks of one size.
inline double dice(const Mask& a, const Mask& b) {
  std::size_t both = 0, sum = 0;
  for (std::size_t n = 0; n < a.values.size(); ++n) {
    both += a.values[n] && b.values[n] ? 1 : 0;
    sum += static_cast<std::size_t>(a.values[n] ? 1 : 0) + (b.values[n] ? 1 : 0);
  }
  return sum == 0 ? 1 : 2.0 * static_cast<double>(both) / static_cast<double>(sum);
}

}  // namespace osteon
