#pragma once

#include <cstdint>
#include <vector>

#include "cloud.h"
#include "polytope.h"

namespace osteon::hull {

/// Indices of the points that may lie outside the polytope, or on it, rising: all but those that
/// lie within a ball inside it or, in their cell of directions, nearer to the origin than its
/// surface is anywhere (Akl and Toussaint 1978, with a table for the polyhedron). Over the cells of
/// a cube around the origin the largest w.q of all facets is a convex function, so in a cell it is
/// largest at a corner. Conservative by more than rounding.
std::vector<std::uint32_t> outside_reach(const Cloud& cloud, Polytope& polytope);

}  // namespace osteon::hull
