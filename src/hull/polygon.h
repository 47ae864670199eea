#pragma once

#include <cstdint>
#include <vector>

#include "cloud.h"

namespace osteon::hull {

/// Coordinate axes i, j onto which a plane projects without collapsing.
struct Projection {
  int i = 0;
  int j = 1;
};

/// Axes for the plane of a, b, c (not on a line), in the order in which a, b, c turn positively.
Projection projection_of(const Cloud& cloud, std::uint32_t a, std::uint32_t b, std::uint32_t c);

/// Corners of the convex hull of points of one plane, counter-clockwise seen from the side from
/// which `a`, `b`, `c` (of that plane, not on a line) run counter-clockwise, the first one lowest
/// in the projection's axis i, then j. Exact; points inside and on edges are left out.
std::vector<std::uint32_t> wrap_polygon(const Cloud& cloud, std::vector<std::uint32_t> points,
                                        std::uint32_t a, std::uint32_t b, std::uint32_t c);

}  // namespace osteon::hull
