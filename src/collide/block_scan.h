#pragma once

#include <cstdint>

#include "osteon/collide/convex_body.h"

namespace osteon {

/// A plane and how far a point lies beyond it.
struct Excess {
  double value = 0;
  std::uint32_t plane = kNone;
  static constexpr std::uint32_t kNone = 0xffffffffu;
};

/// Plane that `u` (from the body's centre, in its frame) exceeds most, among those exceeded by more
/// than `floor`; {floor, kNone} when there is none. Skips groups and runs of planes by their
/// bounds.
Excess most_exceeded(const ConvexBody& body, const Vec3& u, double floor);

/// A plane that `u` exceeds by more than `floor`, likely to be among those exceeded most: a look at
/// one run. {floor, kNone} says nothing of the others.
Excess likely_exceeded(const ConvexBody& body, const Vec3& u, double floor);

/// Plane of lowest index that `u` exceeds by more than `floor`.
Excess first_exceeded(const ConvexBody& body, const Vec3& u, double floor);

/// Fills the bounds of the body's runs and groups of planes and vertices. `facet_points`: a point
/// on each plane's facet, in the hull's frame.
void make_blocks(ConvexBody& body, const std::vector<Vec3>& facet_points);

}  // namespace osteon
