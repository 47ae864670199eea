#pragma once

#include <cstdint>

#include "osteon/base/types.h"

namespace osteon {

/// Seeded generator with the same stream on every compiler (SplitMix64; Steele, Lea, Flood 2014).
/// Draw into named variables: the order in which arguments are evaluated is not fixed in C++.
class Random {
 public:
  explicit Random(std::uint64_t seed) : state_(seed) {}
  std::uint64_t next();
  /// Uniform in [0, 1).
  double uniform();
  /// Uniform in [lo, hi).
  double uniform(double lo, double hi);
  /// Normal deviate (Marsaglia's polar method).
  double normal(double mean, double deviation);
  /// Uniform on the unit sphere.
  Vec3 direction();
  /// Uniform rotation.
  Quat rotation();

 private:
  std::uint64_t state_;
};

}  // namespace osteon
