#pragma once

#include "osteon/mesh/tri_mesh.h"

namespace osteon {

/// Smooths without shrinking: each round moves every vertex by `lambda` towards the mean of its
/// neighbours, then by `mu` (negative, larger) away from it (Taubin, SIGGRAPH 1995, eq. 9).
struct TaubinOptions {
  int rounds = 10;
  double lambda = 0.5;
  double mu = -0.53;
};
void smooth_taubin(TriMesh& mesh, const TaubinOptions& options = {});

/// Indices of each vertex's neighbours, `neighbour[first[v]]` to `neighbour[first[v + 1]]`, without
/// repetition where the mesh is closed.
struct VertexRings {
  std::vector<std::uint32_t> first, neighbour;
};
VertexRings vertex_rings(const TriMesh& mesh);

}  // namespace osteon
