#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "exact/place_value.h"
#include "facet_table.h"
#include "height_grid.h"

namespace osteon::hull {

/// Up to which a peak that was searched for may fall short, or a twentieth of it, m.
inline constexpr double kPeakError_m = 2e-5;

/// What is known of a triangle and of its two halves.
struct KnownHeight {
  double height = std::numeric_limits<double>::quiet_NaN();  ///< over its middle, exact
  float most = std::numeric_limits<float>::infinity();       ///< no place of it stands higher
  std::uint32_t near = 0;    ///< triangle of the mesh that is closest to the middle
  std::uint32_t halves = 0;  ///< index of the first; 0: none
};

/// Heights that were looked up in the mesh, by facet.
struct KnownHeights {
  std::vector<KnownHeight> nodes;
  FacetTable<std::uint32_t> roots;  ///< index of a facet's own
  std::uint32_t make(std::uint32_t count);
  std::uint32_t root_of(const Corners& facet);
};

/// Finds the place of most need by branch and bound: over a triangle the height is at most that of
/// its middle and the way to its farthest corner.
class PeakSearch {
 public:
  /// Ends when the need is above `enough`; looks for nothing below `floor`.
  PeakSearch(HeightGrid& grid, const PlaceValue& value, KnownHeights& known, double floor,
             double enough, Peak& best)
      : grid_(grid), value_(value), known_(known), floor_(floor), enough_(enough), best_(best) {}

  void search(const Corners& facet) { search(facet, known_.root_of(facet)); }

 private:
  void search(const Corners& t, std::uint32_t at);
  void search_halves(const Corners& t, std::uint32_t at);
  double bar() const;
  bool stays_below(const Corners& t, double most, std::uint32_t at);

  HeightGrid& grid_;
  const PlaceValue& value_;
  KnownHeights& known_;
  double floor_;
  double enough_;
  Peak& best_;
  std::uint32_t last_ = 0;  ///< triangle of the mesh near the last place
};

}  // namespace osteon::hull
