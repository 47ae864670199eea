#pragma once

#include "osteon/mesh/tri_mesh.h"

namespace osteon {

/// Whether every triangle's corners are vertices of the mesh.
inline bool indices_fit(const TriMesh& mesh) {
  for (const Triangle& t : mesh.triangles)
    for (const std::uint32_t v : t)
      if (v >= mesh.vertices.size()) return false;
  return true;
}

}  // namespace osteon
