#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "osteon/base/types.h"

namespace osteon::hull {

/// Where the ray from the origin through a point leaves a cube of half-side 1.
struct CubeSpot {
  std::uint32_t face;  ///< 2 k for the positive side of axis k, 2 k + 1 for the negative one
  double u, v;         ///< there, along axes k + 1 and k + 2, in [-1, 1] but for rounding
  double reach;        ///< the point's coordinate along axis k, made positive
};

/// The point is not the origin. Without branches: which axis it is cannot be foretold.
inline CubeSpot cube_spot(const Vec3& q) {
  const double ax = std::abs(q.x()), ay = std::abs(q.y()), az = std::abs(q.z());
  const bool not_x = ax < std::max(ay, az);
  const bool not_y = ay < az;
  const std::uint32_t axis = not_x * (1u + not_y);
  const double around[5] = {q.x(), q.y(), q.z(), q.x(), q.y()};
  const double out = around[axis];
  const double reach = std::abs(out);
  const double inverse = 1.0 / reach;
  return {2 * axis + (out < 0), around[axis + 1] * inverse, around[axis + 2] * inverse, reach};
}

/// The point of the cube at u, v of a face.
inline Vec3 on_cube(std::uint32_t face, double u, double v) {
  const auto k = static_cast<int>(face / 2);
  Vec3 q;
  q[k] = face % 2 == 0 ? 1 : -1;
  q[(k + 1) % 3] = u;
  q[(k + 2) % 3] = v;
  return q;
}

/// Which of `cells` equal parts of [-1, 1] holds x; x may stand out by rounding.
inline std::uint32_t part_of(double x, std::uint32_t cells) {
  const auto part = static_cast<std::int32_t>((x + 1) * 0.5 * cells);
  return static_cast<std::uint32_t>(std::clamp(part, 0, static_cast<std::int32_t>(cells) - 1));
}

/// Number of the cell among 6 cells^2.
inline std::uint32_t cell_of(const CubeSpot& spot, std::uint32_t cells) {
  return (spot.face * cells + part_of(spot.v, cells)) * cells + part_of(spot.u, cells);
}

}  // namespace osteon::hull
