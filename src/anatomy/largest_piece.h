#pragma once

#include "osteon/mesh/tri_mesh.h"

namespace osteon {

/// Leaves the piece of the most triangles, the first of equal ones; triangles that share a vertex
/// belong together. Vertices and triangles keep their order.
void keep_largest_piece(TriMesh& mesh);

}  // namespace osteon
