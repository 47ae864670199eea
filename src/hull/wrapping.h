#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "cloud.h"
#include "shell.h"

namespace osteon::hull {

/// Facets as convex polygons, counter-clockwise from outside, corners only.
struct WrappedFacets {
  std::vector<std::uint32_t> corners;  ///< indices in the cloud, polygon after polygon
  std::vector<std::uint32_t> starts{0};
  std::size_t exact_tests = 0;

  std::size_t size() const { return starts.size() - 1; }
  std::span<const std::uint32_t> polygon(std::size_t i) const {
    return {corners.data() + starts[i], starts[i + 1] - starts[i]};
  }
  void add(std::span<const std::uint32_t> polygon_corners);
};

/// Second stage, gift wrapping (Chand, Kapur, "An Algorithm for Convex Polytopes", 1970): turns a
/// plane about each open edge until it meets the next point, and takes all points of that plane
/// into one facet. The points span a volume and hold no copies.
WrappedFacets wrap(const Cloud& cloud, const Shell& shell);

}  // namespace osteon::hull
