#pragma once

#include <vector>

#include "osteon/mesh/tri_mesh.h"

namespace osteon {

/// One cross-section of a round bar whose middle line lies in the x-z plane.
struct TubeRing {
  Vec3 center = Vec3::Zero();
  Vec3 along = Vec3::UnitZ();  ///< unit, direction of the bar, in the x-z plane
  double radius_m = 0;
};

/// Closed surface over the rings, in order, with a point at each end. Counter-clockwise from
/// outside. Needs at least one ring.
TriMesh sweep_tube(const Vec3& first_point, const std::vector<TubeRing>& rings,
                   const Vec3& last_point, int segments);

}  // namespace osteon
