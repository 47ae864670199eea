#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "osteon/mesh/tri_mesh.h"

namespace osteon {

/// Of each vertex the lowest one of its piece; triangles that share a vertex belong together.
std::vector<std::uint32_t> piece_of_vertices(const TriMesh& mesh);

/// The lowest vertices of the `count` pieces of the most triangles, largest first, of equal ones
/// the first; fewer where there are fewer.
std::vector<std::uint32_t> largest_pieces(const TriMesh& mesh, std::size_t count);

/// The pieces that have these lowest vertices; vertices and triangles keep their order.
TriMesh take_pieces(const TriMesh& mesh, const std::vector<std::uint32_t>& pieces);

/// Leaves the `count` largest pieces, as above. Vertices and triangles keep their order.
void keep_largest_pieces(TriMesh& mesh, std::size_t count);

}  // namespace osteon
