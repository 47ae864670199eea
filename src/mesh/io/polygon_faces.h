#pragma once

#include <cstdint>
#include <vector>

#include "osteon/mesh/tri_mesh.h"

namespace osteon {

/// A polygon with more corners is refused.
inline constexpr std::size_t kMostCorners = 200;

/// Adds a polygon as triangles, concave ones too. False when a corner is no vertex or there are
/// fewer than three corners or more than kMostCorners.
bool add_polygon(TriMesh& mesh, const std::vector<std::uint32_t>& corners);

}  // namespace osteon
