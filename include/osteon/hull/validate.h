#pragma once

#include <span>
#include <string>
#include <vector>

#include "osteon/hull/hull.h"

namespace osteon {

/// Checks a hull without the builder's code: closed 2-manifold of Euler characteristic 2, every
/// triangle counter-clockwise, unit outward planes through their vertices, convex, every input
/// point inside within `tolerance_m`, every vertex an input point. Returns what is wrong, empty
/// when sound. Takes time by points times planes: for tests and tools.
std::vector<std::string> validate_hull(const Hull& hull, std::span<const Vec3> points,
                                       double tolerance_m = 1e-9);

}  // namespace osteon
