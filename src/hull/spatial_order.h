#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "polytope.h"

namespace osteon::hull {

struct SpatialOrder {
  std::vector<std::uint32_t> points;  ///< neighbours follow one another; no copies of one place
  std::size_t copies = 0;             ///< left out
};

/// Orders points of the cloud by a Hilbert curve over their directions from the polytope's origin.
/// Of points at one place the first of the input is kept; those where the polytope has a vertex are
/// left out, and the vertex is then named for the first of the input.
SpatialOrder spatial_order(const Cloud& cloud, Polytope& polytope,
                           std::span<const std::uint32_t> points);

}  // namespace osteon::hull
