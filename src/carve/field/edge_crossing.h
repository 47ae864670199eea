#pragma once

#include "field/node_window.h"
#include "osteon/base/types.h"

namespace osteon {

/// Where the surface crosses an edge of the grid.
struct EdgeCrossing {
  double way = 0;              ///< from the edge's lower node, 0 to 1
  Vec3 normal = Vec3::Zero();  ///< unit, out of what is left
};

/// On the edge from `node` to node + stride, of which one end is left. What is left ends where the
/// first of bone and cut does, and the normal is of that one.
EdgeCrossing edge_crossing(const NodeWindow& window, double cell_um, int node, int stride);

}  // namespace osteon
