#pragma once

#include <functional>

#include "tet/tet_work.h"

namespace osteon {

/// Distance of a point from the surface that the boundary follows, m.
using DistanceToSurface = std::function<double(const Vec3&)>;

/// Removes an edge when that makes the least worth around it better; elements of the polygon around
/// it take its place. An edge of the boundary goes only where the boundary's new edge lies no
/// further from the surface than `slack_m` beyond the old one.
bool remove_edge(TetWork& work, std::uint32_t a, std::uint32_t b, const DistanceToSurface& distance,
                 double slack_m);

/// Puts an edge in place of face `face` of element t when that makes the worse of its two elements
/// better.
bool remove_face(TetWork& work, std::uint32_t t, std::size_t face);

}  // namespace osteon
