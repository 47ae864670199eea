#pragma once

#include <array>

#include "osteon/mesh/tri_mesh.h"

namespace osteon {

/// True when the two triangles of a mesh pass through each other; see self_crossing.h for what
/// counts.
bool triangles_cross(const std::vector<Vec3>& vertices, const Triangle& a, const Triangle& b);

}  // namespace osteon
