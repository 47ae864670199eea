#pragma once

#include <array>
#include <cstddef>

#include "four_lanes.h"
#include "osteon/base/types.h"

namespace osteon {

/// Values and slopes of the four cubic B-splines that reach a place t of a cell, 0 <= t <= 1.
struct CubicSpline {
  std::array<double, 4> w, d;
  explicit CubicSpline(double t) {
    const double u = 1 - t;
    const double t2 = t * t;
    w[0] = u * u * u / 6;
    w[1] = (4 - 6 * t2 + 3 * t2 * t) / 6;
    w[3] = t2 * t / 6;
    w[2] = 1 - w[0] - w[1] - w[3];
    d[0] = -0.5 * u * u;
    d[1] = 1.5 * t2 - 2 * t;
    d[3] = 0.5 * t2;
    d[2] = -(d[0] + d[1] + d[3]);
  }
};

/// Value and slope per cell of a tensor product of splines.
struct SplineSum {
  double value = 0;
  Vec3 slope = Vec3::Zero();
};

/// Sum over the 4 x 4 x 4 nodes about a place. `row(j, k)`: four neighbours along x. First over z
/// and y for all four of x at once, then over x.
template <class Row>
SplineSum sum_splines(const Row& row, const CubicSpline& x, const CubicSpline& y,
                      const CubicSpline& z) {
  FourLanes v, along_y, along_z;
  for (std::size_t k = 0; k < 4; ++k) {
    FourLanes sum, sum_y;
    for (std::size_t j = 0; j < 4; ++j) {
      const FourLanes h = row(j, k);
      sum.add(y.w[j], h);
      sum_y.add(y.d[j], h);
    }
    v.add(z.w[k], sum);
    along_y.add(z.w[k], sum_y);
    along_z.add(z.d[k], sum);
  }
  const FourLanes w = FourLanes::load(x.w.data()), d = FourLanes::load(x.d.data());
  return {v.dot(w), {v.dot(d), along_y.dot(w), along_z.dot(w)}};
}

}  // namespace osteon
