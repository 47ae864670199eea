#pragma once

#include "height_grid.h"
#include "osteon/hull/hull.h"

namespace osteon::hull {

/// How a hull stands over the surface that it was made from.
struct Excess {
  double height = 0;       ///< most, m
  Vec3 at = Vec3::Zero();  ///< where, on the hull
  double moment = 0;       ///< integral of the height's square over the hull, m^4
};

/// Samples the hull's triangles, halved until none is longer than `spacing`.
Excess excess(const Hull& hull, HeightGrid& grid, double spacing);

}  // namespace osteon::hull
