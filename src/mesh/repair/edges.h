#pragma once

#include <cstdint>
#include <vector>

#include "osteon/mesh/tri_mesh.h"

namespace osteon {

/// One side of a triangle: from its `corner` to the next corner.
struct EdgeUse {
  std::uint32_t lo = 0;  ///< smaller vertex index
  std::uint32_t hi = 0;
  std::uint32_t triangle = 0;
  std::uint8_t corner = 0;
  bool ascending = true;  ///< the triangle runs from lo to hi
};

/// All sides of all triangles, sorted by (lo, hi, triangle, corner): uses of one edge are
/// neighbours.
std::vector<EdgeUse> edge_uses(const std::vector<Triangle>& triangles);

/// Calls visit(first, last) with the range of uses of each edge, in order.
template <class Visit>
void for_each_edge(const std::vector<EdgeUse>& uses, Visit visit) {
  for (auto first = uses.begin(); first != uses.end();) {
    auto last = first;
    while (last != uses.end() && last->lo == first->lo && last->hi == first->hi) ++last;
    visit(first, last);
    first = last;
  }
}

/// Number of the component of each triangle (triangles that share an edge belong together),
/// counted from 0 in the order of their first triangles.
std::vector<std::uint32_t> triangle_components(const std::vector<Triangle>& triangles,
                                               const std::vector<EdgeUse>& uses);

}  // namespace osteon
