#include "hex/hex_stiffness.h"

#include <array>

namespace osteon {
namespace {

using CornerSlopes = Eigen::Matrix<double, 8, 3>;

// Gradients of the corners' trilinear weights in a cube from 0 to 1.
CornerSlopes slopes_at(const std::array<double, 3>& at) {
  CornerSlopes out;
  for (int c = 0; c < 8; ++c) {
    const std::array<int, 3> high{c % 2, c / 2 % 2, c / 4};
    for (std::size_t k = 0; k < 3; ++k) {
      double slope = high[k] ? 1 : -1;
      for (std::size_t j = 0; j < 3; ++j)
        if (j != k) slope *= high[j] ? at[j] : 1 - at[j];
      out(c, static_cast<Eigen::Index>(k)) = slope;
    }
  }
  return out;
}

}  // namespace

// k_ab = lambda g_a g_b^T + mu g_b g_a^T + mu (g_a . g_b) 1, integrated by Gauss's two points along
// each axis.
Eigen::Matrix<double, 24, 24> unit_cube_stiffness(double poisson) {
  const double mu = 1 / (2 * (1 + poisson)), lambda = 2 * mu * poisson / (1 - 2 * poisson);
  constexpr double kLow = 0.21132486540518713, kHigh = 0.78867513459481287;
  Eigen::Matrix<double, 24, 24> out = Eigen::Matrix<double, 24, 24>::Zero();
  for (int q = 0; q < 8; ++q) {
    const CornerSlopes g =
        slopes_at({q % 2 ? kHigh : kLow, q / 2 % 2 ? kHigh : kLow, q / 4 ? kHigh : kLow});
    for (int a = 0; a < 8; ++a)
      for (int b = 0; b < 8; ++b)
        for (int r = 0; r < 3; ++r)
          for (int c = 0; c < 3; ++c) {
            double k = lambda * g(a, r) * g(b, c) + mu * g(b, r) * g(a, c);
            if (r == c) k += mu * (g(a, 0) * g(b, 0) + g(a, 1) * g(b, 1) + g(a, 2) * g(b, 2));
            out(3 * a + r, 3 * b + c) += k / 8;
          }
  }
  return out;
}

}  // namespace osteon
