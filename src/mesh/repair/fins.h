#pragma once

#include <cstddef>

#include "osteon/mesh/tri_mesh.h"

namespace osteon {

/// Drops fins: small patches with a free rim that stand on edges which have two triangles without
/// them. Returns how many triangles went.
std::size_t drop_fins(TriMesh& mesh);

}  // namespace osteon
