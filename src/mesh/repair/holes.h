#pragma once

#include <cstddef>

#include "osteon/mesh/tri_mesh.h"

namespace osteon {

struct HoleCount {
  std::size_t filled = 0;
  std::size_t ends = 0;  ///< of those filled: as wide as the part itself, such as a cut shaft
  std::size_t open = 0;
};

/// Fills the holes whose rim has up to `largest_edges` edges or is flat, see repair. Triangles must
/// be oriented alike.
HoleCount fill_holes(TriMesh& mesh, std::size_t largest_edges);

}  // namespace osteon
