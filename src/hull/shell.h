#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "cloud.h"
#include "osteon/hull/hull.h"

namespace osteon::hull {

/// What the first stage leaves: a convex polyhedron and the points outside of it. These survivors
/// are numbered anew, the polyhedron's vertices first.
struct Shell {
  struct Facet {
    std::array<std::uint32_t, 3> v;         ///< counter-clockwise from outside
    std::array<std::uint32_t, 3> adjacent;  ///< across v[i], v[i + 1]
    FilterPlane plane;
    std::uint32_t outside_begin, outside_end;  ///< survivors kept at this facet, strictly above it
  };

  std::vector<std::uint32_t> points;  ///< index in the cloud of each survivor; no copies
  std::uint32_t vertices = 0;         ///< how many of them are vertices of the polyhedron
  std::vector<Facet> facets;
  std::size_t duplicates = 0;
  std::optional<HullFailure> failure;
};

}  // namespace osteon::hull
