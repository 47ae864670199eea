#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "osteon/base/types.h"
#include "tunnel_prism.h"

namespace osteon::tunnel {

/// A side of a plane region: from one vertex to another, the region on its left.
using Side = std::pair<std::uint32_t, std::uint32_t>;

/// A corner of a plane region: the number of its vertex and its place in the plane.
struct FlatPoint {
  std::uint32_t vertex = 0;
  Vec2 at = Vec2::Zero();
};

/// Triangulates a plane region that its directed sides bound, with parts and holes, by cutting
/// ears; holes are joined to their surroundings by bridges (Eberly, "Triangulation by ear
/// clipping"). Adds counter-clockwise triangles that use every side once, and no triangle without
/// area but where rounding left no other. `points` names every vertex of the sides once. False
/// where the sides do not close to loops or the loops cross.
bool fill_region(std::vector<FlatPoint> points, const std::vector<Side>& sides,
                 std::vector<Triangle>& triangles);

}  // namespace osteon::tunnel
