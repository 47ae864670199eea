#pragma once

#include <array>

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

}  // namespace osteon
