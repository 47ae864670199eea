#pragma once

#include <array>
#include <cstdint>

#include "osteon/base/types.h"

namespace osteon {

/// Velocity from positions in steps of a sensor's resolution: first-order adaptive windowing
/// (Janabi-Sharifi, Hayward, Chen 2000, "end-fit" form). For each axis the longest of the last
/// windows in which every position lies within the resolution of the line between its ends: short
/// while the velocity changes, long while it is steady. Its own memory.
class VelocityEstimator {
 public:
  explicit VelocityEstimator(double resolution) : noise_(resolution) {}
  void reset() { count_ = 0; }
  /// Velocity after a reading at that time; zero after the first. A time that does not rise
  /// replaces nothing and gives the last velocity.
  Vec3 add(std::int64_t time_ns, const Vec3& position);

 private:
  static constexpr std::size_t kWindow = 16;
  struct Reading {
    std::int64_t time_ns = 0;
    Vec3 position = Vec3::Zero();
  };
  const Reading& back(std::size_t i) const { return readings_[(newest_ + kWindow - i) % kWindow]; }
  double slope(int axis) const;
  bool fits(int axis, std::size_t n, double slope) const;

  double noise_;
  std::array<Reading, kWindow> readings_{};
  std::size_t newest_ = 0;
  std::size_t count_ = 0;
  Vec3 velocity_ = Vec3::Zero();
};

}  // namespace osteon
