#pragma once

#include <optional>

#include "exact/place_value.h"
#include "facet_samples.h"
#include "height_grid.h"
#include "osteon/hull/hull.h"
#include "peak_search.h"

namespace osteon::hull {

/// How a hull stands over the surface that it was made from.
struct Excess {
  Peak peak;
  double moment = 0;  ///< integral over the hull of the square of the need, m^4
};

/// Measures hulls over one mesh. It remembers what it finds of facets, which many hulls share; that
/// changes what a measurement costs, not what it finds. For one thread.
class ExcessMeter {
 public:
  /// Samples lie `spacing_m` apart, in the search for cuts twice as far.
  ExcessMeter(HeightGrid& grid, PlaceValue value, double spacing_m);
  ExcessMeter(const ExcessMeter&) = delete;
  ExcessMeter& operator=(const ExcessMeter&) = delete;

  const PlaceValue& value() const { return value_; }
  void count_all_alike();

  /// By samples of the hull's facets, on the grid.
  Excess sampled(const Hull& hull);

  /// The moment by sparser samples; none when it and `base` come to `limit` or more.
  std::optional<double> moment_below(const Hull& hull, double base, double limit);

  /// What was sampled, with the largest need found by distances to the mesh itself where it is
  /// above `floor`, short of it by no more than kPeakError_m or a twentieth; or some need above
  /// `enough`.
  Excess exact(const Hull& hull, const Excess& sampled, double floor, double enough);

 private:
  HeightGrid& grid_;
  PlaceValue value_;
  FacetSamples fine_, sparse_;
  KnownHeights heights_;
};

}  // namespace osteon::hull
