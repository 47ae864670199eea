#pragma once

#include "field/node_window.h"
#include "osteon/carve/carved_surface.h"

namespace osteon {

/// Surface of one block from the nodes in and about it. A function of these nodes alone.
void make_patch(const NodeWindow& window, const BlockGrid& grid, const std::array<int, 3>& block,
                SurfacePatch& out);

}  // namespace osteon
