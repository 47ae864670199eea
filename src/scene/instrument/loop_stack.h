#pragma once

#include <span>
#include <vector>

#include "osteon/mesh/tri_mesh.h"

namespace osteon {

/// Points of one cross-section, counter-clockwise seen against the way to the next one.
using Loop = std::vector<Vec3>;

/// Closed surface over loops of equally many points, in order, with a point at each end.
/// Counter-clockwise from outside. Needs at least one loop of three points.
TriMesh stack_loops(const Vec3& first_point, std::span<const Loop> loops, const Vec3& last_point);

/// The same without ends: the last loop is joined to the first. Needs three loops.
TriMesh ring_of_loops(std::span<const Loop> loops);

}  // namespace osteon
