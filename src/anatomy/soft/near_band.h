#pragma once

#include <cstddef>

#include "bone/near_solid.h"
#include "soft/soft_band.h"

namespace osteon {

/// The spans of a band that decide its value in a vicinity: all of them, at first. The band must
/// live longer.
class NearBandSpans {
 public:
  explicit NearBandSpans(const LaidBand& band);

  /// distance(band, p), bit by bit.
  double operator()(const Vec3& p) const { return distance(*band_, p, first_, last_); }

  /// Narrowed to a vicinity that lies in the one before; tells the spread of the values there.
  /// A span's value lies between d - w and d sqrt(1 + s) - h + e, where d is the distance to its
  /// middle line, w the greatest of its half sizes, h the least half-thickness, e how much thicker
  /// than wide it is at most, and s how far from square its axes come to stand between its ends.
  NearBandSpans within(const Vicinity& where, Spread& values) const;

 private:
  Spread span_spread(std::size_t span, const Vicinity& where) const;

  const LaidBand* band_;
  std::size_t first_ = 0, last_ = 0;  ///< spans: first <= span < last
};

}  // namespace osteon
