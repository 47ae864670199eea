#pragma once

#include <cstddef>
#include <vector>

#include "exact/place_value.h"
#include "facet_table.h"
#include "height_grid.h"

namespace osteon::hull {

/// Samples triangles of hulls on the grid, halved until none is longer than the spacing.
class FacetSamples {
 public:
  FacetSamples(HeightGrid& grid, const PlaceValue& value, double spacing_m)
      : grid_(grid), value_(value), spacing2_(spacing_m * spacing_m) {}

  /// Adds what the triangle has to a hull's moment and peak.
  void add(const Corners& t, double& moment, Peak& peak);
  /// When what places count has changed.
  void forget();

 private:
  struct Known {
    std::size_t first = 0, count = 0;  ///< of `terms_`
    Peak peak;
  };
  void halve(const Corners& t, bool near, Peak& peak);
  void sample(const Corners& t, Peak& peak);

  HeightGrid& grid_;
  const PlaceValue& value_;
  double spacing2_;
  FacetTable<Known> known_;
  std::vector<double> terms_;  ///< what the samples that stand over the mesh add to the moment
};

}  // namespace osteon::hull
