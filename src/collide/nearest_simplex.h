#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "osteon/base/types.h"

namespace osteon {

/// A point of the difference of two bodies and where it comes from.
struct DifferencePoint {
  Vec3 w = Vec3::Zero();     ///< of body less of axis
  Vec3 p_a = Vec3::Zero();   ///< of the body
  Vec3 p_ax = Vec3::Zero();  ///< of the axis
  std::uint32_t id = 0;      ///< the caller's name for it
};

/// Up to four points and the weights of the point of their hull that is nearest to the origin.
struct NearestSimplex {
  std::array<DifferencePoint, 4> points;
  std::array<double, 4> weights{};
  std::size_t count = 0;

  Vec3 nearest() const;
  Vec3 on_body() const;
  Vec3 on_axis() const;
};

/// Adds a point and keeps those that carry the nearest point; the new one is taken to be among
/// them. True when the origin lies inside all four.
bool add_point(NearestSimplex& simplex, const DifferencePoint& point);

}  // namespace osteon
