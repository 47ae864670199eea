#pragma once

#include <span>

#include "osteon/hull/hull.h"
#include "osteon/mesh/tri_mesh.h"

namespace osteon {

/// The outer surface of the union of convex pieces, as loose triangles: the pieces' own, less what
/// lies in or against another piece. Where two pieces cross, triangles are halved down to `seam_m`
/// and then kept or left out whole.
TriMesh union_surface(std::span<const Hull> pieces, double seam_m);

}  // namespace osteon
