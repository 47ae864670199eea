#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "cloud.h"
#include "polytope.h"

namespace osteon::hull {

/// Facets as convex polygons, counter-clockwise from outside, corners only.
struct WrappedFacets {
  std::vector<std::uint32_t> corners;  ///< indices in the cloud, polygon after polygon
  std::vector<std::uint32_t> starts{0};

  std::size_t size() const { return starts.size() - 1; }
  std::span<const std::uint32_t> polygon(std::size_t i) const {
    return {corners.data() + starts[i], starts[i + 1] - starts[i]};
  }
};

/// Wraps the hull, after Chand and Kapur, "An Algorithm for Convex Polytopes" (1970): starts at an
/// edge of the hull and turns about each open edge to the facet beyond, which takes in all points
/// of its plane. What comes next about an edge the polytope knows. A facet of one triangle begins
/// at the edge by which it was reached, one of several at its lowest corner (see wrap_polygon); so
/// the order is the hull's own, whichever way the polytope grew, but for facets in whose plane it
/// holds points that are no corners.
WrappedFacets wrap(const Cloud& cloud, const Polytope& polytope);

}  // namespace osteon::hull
