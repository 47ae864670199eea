#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "osteon/mesh/tri_mesh.h"

namespace osteon {

/// Triangulation of a closed polygon in space that has the least area, by dynamic programming in
/// O(n^3) (Barequet and Sharir 1995, section 3.2). Triangles without area come last. Corners are
/// numbered by `loop`; the triangles run the way of the loop. A pair of corners for which
/// `may_join` is false gets no diagonal. Empty when there is no triangulation.
std::vector<Triangle> triangulate_loop(
    const std::vector<Vec3>& vertices, const std::vector<std::uint32_t>& loop,
    const std::function<bool(std::uint32_t, std::uint32_t)>& may_join);

}  // namespace osteon
