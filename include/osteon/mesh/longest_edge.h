#pragma once

#include <array>
#include <cstddef>

#include "osteon/base/types.h"

namespace osteon {

struct LongestEdge {
  std::size_t from = 0;  ///< the edge runs from this corner to the next
  double length2 = -1;   ///< squared, m^2
};

/// Of a triangle's edges the longest; of equal ones the first.
inline LongestEdge longest_edge(const std::array<Vec3, 3>& corners) {
  LongestEdge out;
  for (std::size_t k = 0; k < 3; ++k) {
    const double length2 = (corners[(k + 1) % 3] - corners[k]).squaredNorm();
    if (length2 > out.length2) out = {k, length2};
  }
  return out;
}

}  // namespace osteon
