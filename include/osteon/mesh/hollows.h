#pragma once

#include <cstddef>

#include "osteon/mesh/tri_mesh.h"

namespace osteon {

/// Walls up the hollows of a closed, outward mesh and returns how many there were. A hollow is room
/// inside that holds a ball of `ball_radius_m` and that such a ball cannot reach from outside: the
/// marrow of a bone whose shell is thin, with holes where the scan lost it. What of the solid's
/// outside a ball reaches stays. A cavity that is closed all around is left out and the triangles
/// of the rest stay. A mesh whose hollows open through holes is made anew (isosurface) with
/// vertices on the old surface, on cells of a quarter of the radius, and each opening gets a lid as
/// a ball would rest on it; should that make no surface on which each edge has two triangles, the
/// hollows stay and are not counted. Any other mesh stays bit by bit, and so does one that is not
/// closed. Where the mesh would take more than 64 million cells, they and the ball are as much
/// larger.
std::size_t fill_hollows(TriMesh& mesh, double ball_radius_m = 0.001);

}  // namespace osteon
