#pragma once

#include <cstdint>

#include "osteon/mesh/tri_mesh.h"

namespace osteon {

/// Puts a part behind what the mesh holds; both stay separate pieces of surface. Not of a mesh to
/// itself.
inline void append_mesh(TriMesh& to, const TriMesh& part) {
  const auto first = static_cast<std::uint32_t>(to.vertices.size());
  to.vertices.insert(to.vertices.end(), part.vertices.begin(), part.vertices.end());
  for (const Triangle& t : part.triangles)
    to.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
}

}  // namespace osteon
