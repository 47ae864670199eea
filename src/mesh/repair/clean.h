#pragma once

#include <cstddef>
#include <vector>

#include "osteon/mesh/tri_mesh.h"

namespace osteon {

/// Erases the triangles marked, keeps the order of the others. Returns how many went.
std::size_t erase_marked(TriMesh& mesh, const std::vector<char>& marked);

/// Drops triangles that name a vertex twice. Returns how many.
std::size_t drop_collapsed_triangles(TriMesh& mesh);

/// Drops all but the first of the triangles over the same three vertices; drops that one too where
/// two faced each other and nothing but a fold or a membrane inside the surface was lost. Returns
/// how many went.
std::size_t drop_duplicate_triangles(TriMesh& mesh);

/// Removes triangles without area: flips the longest edge into the neighbour, so that no gap opens;
/// at a boundary drops the triangle. Returns how many went. One stays where the flip would put a
/// third triangle on an edge.
std::size_t mend_flat_triangles(TriMesh& mesh);

/// Without area: lower than 1e-10 of its longest side.
bool is_flat(const Vec3& a, const Vec3& b, const Vec3& c);

}  // namespace osteon
