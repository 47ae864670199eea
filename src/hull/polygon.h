#pragma once

#include <cstdint>
#include <vector>

#include "cloud.h"

namespace osteon::hull {

/// Corners of the convex hull of points of one plane, counter-clockwise seen from the side from
/// which `a`, `b`, `c` (of that plane, not on a line) run counter-clockwise. Exact; points inside
/// and on edges are left out.
std::vector<std::uint32_t> wrap_polygon(const Cloud& cloud, std::vector<std::uint32_t> points,
                                        std::uint32_t a, std::uint32_t b, std::uint32_t c);

}  // namespace osteon::hull
