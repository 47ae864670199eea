#pragma once

#include "osteon/mesh/tri_mesh.h"

namespace osteon::hull {

/// The mesh without the walls of closed cavities (connected parts that enclose a negative volume):
/// nothing can reach them.
TriMesh outer_surface(const TriMesh& mesh);

}  // namespace osteon::hull
