#pragma once

#include <span>
#include <vector>

#include "osteon/base/types.h"

namespace osteon::hull {

/// Plane of a convex polygon, counter-clockwise from outside. The normal is that of the polygon's
/// roundest triangle, good to rounding; d is the largest n.x of the polygon's corners, so none is
/// outside.
Plane facet_plane(std::span<const Vec3> points, std::span<const std::uint32_t> polygon);

}  // namespace osteon::hull
