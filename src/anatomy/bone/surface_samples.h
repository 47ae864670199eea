#pragma once

#include <cstddef>
#include <vector>

#include "osteon/mesh/tri_mesh.h"

namespace osteon {

/// `count` points spread evenly by area over a surface that has some: in steps of equal area along
/// the triangles, within each at the next place of a sequence of low discrepancy (M. Roberts, "The
/// unreasonable effectiveness of quasirandom sequences", 2018). The same mesh gives the same
/// points.
std::vector<Vec3> surface_samples(const TriMesh& mesh, std::size_t count);

}  // namespace osteon
