#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "tunnel_edges.h"
#include "tunnel_fill.h"
#include "tunnel_patch.h"
#include "tunnel_prism.h"

namespace osteon::tunnel {

/// A place where a column of the prism goes through the surface.
struct ColumnPoint {
  double z = 0;
  std::uint32_t point = 0;
  bool leaving = false;  ///< bone ends here as z grows
};

/// The flat ends of the drill.
enum End : std::size_t { kStart = 0, kEnd = 1 };

/// What is known after every facet was cut by the prism.
struct Rims {
  std::vector<Triangle> kept;                     ///< of the surface
  std::vector<std::vector<ColumnPoint>> columns;  ///< of each column, by z
  std::vector<std::vector<Side>> on_sides;        ///< rims on each side, the wall on their left
  /// Crossings of the ends' edges: of each end and each side.
  std::array<std::vector<std::vector<std::uint32_t>>, 2> on_ends;
  /// Sides of the surface's cut by each end's plane within the prism.
  std::array<std::vector<Side>, 2> across_ends;
};

/// Cuts every facet. Adds a point to the patch wherever a column meets one. False where the facets
/// do not fit together.
bool cut_facets(Patch& patch, const Prism& prism, const EdgeTable& edges, Rims& rims);

}  // namespace osteon::tunnel
