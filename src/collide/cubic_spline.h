#pragma once

#include <array>
#include <cstddef>

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

/// Sum over the 4 x 4 x 4 nodes about a place. `row(j, k)`: the first of four neighbours along x.
template <class Row>
SplineSum sum_splines(const Row& row, const CubicSpline& x, const CubicSpline& y,
                      const CubicSpline& z) {
  SplineSum out;
  for (std::size_t k = 0; k < 4; ++k) {
    double v = 0, dx = 0, dy = 0;
    for (std::size_t j = 0; j < 4; ++j) {
      const auto* h = row(j, k);
      const double h0 = h[0], h1 = h[1], h2 = h[2], h3 = h[3];
      const double along = (x.w[0] * h0 + x.w[1] * h1) + (x.w[2] * h2 + x.w[3] * h3);
      const double along_dx = (x.d[0] * h0 + x.d[1] * h1) + (x.d[2] * h2 + x.d[3] * h3);
      v += y.w[j] * along;
      dx += y.w[j] * along_dx;
      dy += y.d[j] * along;
    }
    out.value += z.w[k] * v;
    out.slope.x() += z.w[k] * dx;
    out.slope.y() += z.w[k] * dy;
    out.slope.z() += z.d[k] * v;
  }
  return out;
}

}  // namespace osteon
