#pragma once

#include <cstddef>

#include "osteon/mesh/tri_mesh.h"

namespace osteon {

/// Removes triangles while the surface moves by no more than about `error_m` (quadric error;
/// Garland and Heckbert 1997, by meshoptimizer) and more than `least_triangles` are left. A closed
/// mesh stays closed: where it would not, it is left as it was.
void decimate(TriMesh& mesh, double error_m, std::size_t least_triangles = 200);

}  // namespace osteon
