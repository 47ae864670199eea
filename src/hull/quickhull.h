#pragma once

#include "cloud.h"
#include "shell.h"

namespace osteon::hull {

/// First stage (Barber, Dobkin, Huhdanpaa, "The Quickhull Algorithm for Convex Hulls", 1996, on the
/// plane x_min, x_max, x_d of the paper): grows a convex polyhedron by farthest points and drops
/// every point found inside or on it. Stops at facets with few points outside, where wrapping is
/// cheaper than more growth. Every corner of the hull is among the survivors.
Shell quickhull(const Cloud& cloud);

}  // namespace osteon::hull
