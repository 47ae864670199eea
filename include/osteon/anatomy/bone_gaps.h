#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "osteon/mesh/tri_mesh.h"

namespace osteon {

/// Two surfaces that lie near each other.
struct BoneGap {
  std::size_t first = 0, second = 0;  ///< indices, first < second
  double gap_m = 0;  ///< least distance between them, or minus the depth of the deepest vertex
};

/// Of closed meshes in one frame, all pairs that are nearer than `reach_m` (0: that overlap), in
/// the order of their indices. Distances run from vertices to the other surface.
std::vector<BoneGap> bone_gaps(std::span<const TriMesh> meshes_W, double reach_m);

}  // namespace osteon
