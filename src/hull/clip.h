#pragma once

#include <utility>

#include "osteon/mesh/tri_mesh.h"

namespace osteon::hull {

/// The part of a surface with n.x <= d and the part with n.x >= d. Both hold the points where edges
/// cross the plane, with the same bits; vertices that no triangle needs are dropped.
std::pair<TriMesh, TriMesh> clip(const TriMesh& surface, const Plane& plane);

}  // namespace osteon::hull
