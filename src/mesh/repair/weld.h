#pragma once

#include <cstddef>

#include "osteon/mesh/tri_mesh.h"

namespace osteon {

/// Numbers vertices in the order in which triangles name them and drops the others. Returns how
/// many were dropped.
std::size_t drop_unused_vertices(TriMesh& mesh);

}  // namespace osteon
