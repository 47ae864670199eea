#pragma once

#include "osteon/mesh/tri_mesh.h"

namespace osteon {

/// How far the convex hull of a mesh stands over its triangles at most, m, to about a hundredth of
/// its size: what is felt of a mesh that is open. Zero where there is no hull.
double hull_height(const TriMesh& mesh);

}  // namespace osteon
