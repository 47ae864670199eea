#pragma once

#include <array>
#include <cstdint>

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

/// Value and slope per cell of a tensor product of cubic B-splines.
struct SplineSum {
  double value = 0;
  Vec3 slope = Vec3::Zero();
};

/// The 4 x 4 x 4 heights about a place: where each four neighbours along x begin, y fastest.
struct SplineRows {
  std::array<const std::int16_t*, 16> row;
  std::int16_t most = 32767;  ///< what is higher counts as this high
};

/// Sum over those heights at a place of the cell, each coordinate 0 to 1. First over z and y for
/// all four of x at once, then over x. The processor's registers set the speed, and no bit of the
/// result.
SplineSum sum_splines(const SplineRows& rows, const Vec3& t);

/// Its value alone, the same bits in less time.
double value_of_splines(const SplineRows& rows, const Vec3& t);

/// The same in registers that every processor has.
SplineSum sum_splines_narrow(const SplineRows& rows, const Vec3& t);
double value_of_splines_narrow(const SplineRows& rows, const Vec3& t);

}  // namespace osteon
