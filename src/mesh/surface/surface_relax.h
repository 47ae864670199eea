#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "osteon/mesh/isosurface.h"

namespace osteon {

/// Evens out the vertices of a quad surface: each round moves a vertex towards the mean of its
/// neighbours, then back along the field's gradient onto the zero surface. No vertex leaves its
/// first place by more than 0.6 of a cell.
void relax_on_surface(const LocalField& field,
                      const std::vector<std::array<std::uint32_t, 4>>& quads,
                      const IsosurfaceOptions& options, std::vector<Vec3>& vertices);

}  // namespace osteon
