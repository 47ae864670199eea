#include <algorithm>
#include <array>
#include <cmath>

#include "osteon/physics/skin_setup.h"

namespace osteon {

SkinRelief::SkinRelief(double cell_m, std::size_t nx, std::vector<double> heights_m)
    : cell_m_(cell_m),
      nx_(static_cast<long>(nx)),
      ny_(static_cast<long>(heights_m.size() / nx)),
      heights_m_(std::move(heights_m)) {
  const auto [lo, hi] = std::minmax_element(heights_m_.begin(), heights_m_.end());
  lowest_m_ = *lo;
  highest_m_ = *hi;
}

// Beyond the border straight on, by one node.
double SkinRelief::node(long i, long j) const {
  if (i < 0) return 2 * node(0, j) - node(1, j);
  if (i >= nx_) return 2 * node(nx_ - 1, j) - node(nx_ - 2, j);
  if (j < 0) return 2 * node(i, 0) - node(i, 1);
  if (j >= ny_) return 2 * node(i, ny_ - 1) - node(i, ny_ - 2);
  return heights_m_[static_cast<std::size_t>(j * nx_ + i)];
}

// Uniform cubic B-splines over the nodes: twice smooth, and off the surface by its curvature times
// a sixth of the cell's square, some hundredths of a millimetre.
SkinRelief::Place SkinRelief::at(const SheetPoint& p) const {
  if (nx_ < 2 || ny_ < 2) return {};
  const auto spline = [](double t) {
    const double s = 1 - t;
    return std::array{s * s * s / 6, (4 - 3 * t * t * (2 - t)) / 6, (4 - 3 * s * s * (2 - s)) / 6,
                      t * t * t / 6};
  };
  const auto slopes = [](double t) {
    const double s = 1 - t;
    return std::array{-s * s / 2, t * (3 * t - 4) / 2, s * (4 - 3 * s) / 2, t * t / 2};
  };
  const auto place = [&](double x, long n) {
    return std::clamp(x / cell_m_ + 0.5 * static_cast<double>(n - 1), 0.0,
                      static_cast<double>(n - 1));
  };
  const double u = place(p.x(), nx_), v = place(p.y(), ny_);
  const long i = std::min(static_cast<long>(u), nx_ - 2),
             j = std::min(static_cast<long>(v), ny_ - 2);
  const double tu = u - static_cast<double>(i), tv = v - static_cast<double>(j);
  const auto wx = spline(tu), wy = spline(tv), dx = slopes(tu), dy = slopes(tv);
  Place out;
  for (long b = 0; b < 4; ++b)
    for (long a = 0; a < 4; ++a) {
      const double h = node(i + a - 1, j + b - 1);
      const auto ia = static_cast<std::size_t>(a), ib = static_cast<std::size_t>(b);
      out.height_m += wx[ia] * wy[ib] * h;
      out.slope += h / cell_m_ * SheetPoint(dx[ia] * wy[ib], wx[ia] * dy[ib]);
    }
  return out;
}

}  // namespace osteon
