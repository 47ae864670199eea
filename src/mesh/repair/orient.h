#pragma once

#include <vector>

#include "osteon/mesh/tri_mesh.h"

namespace osteon {

/// Turns triangles so that the two on every edge agree, by a walk from the first triangle of each
/// patch; a patch keeps the way of most of its area. Marks those turned.
std::vector<char> orient_alike(TriMesh& mesh);

/// Turns whole patches so that triangles face away from the solid: outwards by signed volume, into
/// the cavity for a closed patch inside an odd number of others. A sheet that encloses next to
/// nothing stays. Marks the triangles turned. The patches must be oriented alike.
std::vector<char> orient_outwards(TriMesh& mesh);

}  // namespace osteon
