#pragma once

#include <vector>

#include "osteon/mesh/tri_mesh.h"

namespace osteon {

/// Where triangles pass through each other, draws their vertices back towards where they came from,
/// `home`, round by round, with more of their neighbours the longer it takes. Leaves a mesh without
/// crossings as it is. False where some are left.
bool uncross(TriMesh& mesh, const std::vector<Vec3>& home);

}  // namespace osteon
