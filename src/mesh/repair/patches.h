#pragma once

#include <cstdint>
#include <vector>

#include "osteon/mesh/tri_mesh.h"

namespace osteon {

/// Triangles that are connected by edges of exactly two triangles.
struct Patch {
  std::vector<std::uint32_t> triangles;  ///< in the order of a walk from the lowest
  std::vector<char> against;             ///< of each: faces against the first, by that walk
  Aabb box;
  bool closed = true;  ///< every edge has two triangles that agree
};

/// All patches, in the order of their lowest triangles.
std::vector<Patch> patches_of(const TriMesh& mesh);

double triangle_area(const TriMesh& mesh, std::uint32_t triangle);

}  // namespace osteon
