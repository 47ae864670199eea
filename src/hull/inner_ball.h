#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "osteon/base/types.h"

namespace osteon::hull {

/// Indices of the points that may be corners of the hull, rising: all but those that lie in a ball
/// within a polyhedron of a few hundred far-out points (Akl and Toussaint 1978, with a ball for the
/// polyhedron: one comparison a point). It is a ball in the frame E, in which the points' bounding
/// box is a cube, so an ellipsoid. Conservative by more than rounding. All points finite; small
/// clouds are kept whole.
std::vector<std::uint32_t> outside_inner_ball(std::span<const Vec3> points);

}  // namespace osteon::hull
