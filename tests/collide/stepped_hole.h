#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "osteon/collide/cut_field.h"

namespace osteon::test {

/// A hole along z, open above: narrow through all of the block, wide down to a step. Signed
/// distances in closed form, negative in the hole.
struct SteppedHole {
  double narrow_m = 0.0012;  ///< radius
  double wide_m = 0.00225;   ///< radius
  double step_m = 0.003;     ///< z

  static double one(const Vec3& p, double radius, double end) {
    const double beside = std::hypot(p.x(), p.y()) - radius, below = end - p.z();
    const double outside = std::hypot(std::max(0.0, beside), std::max(0.0, below));
    return outside + std::min(0.0, std::max(beside, below));
  }
  double height_of_cut(const Vec3& p) const {
    return std::min(one(p, narrow_m, -1), one(p, wide_m, step_m));
  }

  CutField cuts(double cell_m = 0.0004) const {
    const int blocks = static_cast<int>(std::ceil(0.032 / (8 * cell_m)));
    const CutGrid grid{cell_m, Vec3::Constant(-0.016), {blocks, blocks, blocks}};
    CutField out(grid, grid.count(), 0);
    std::array<std::int16_t, CutField::kNodes> nodes{};
    std::uint32_t block = 0;
    for (int k = 0; k < blocks; ++k)
      for (int j = 0; j < blocks; ++j)
        for (int i = 0; i < blocks; ++i) {
          for (int n = 0; n < 512; ++n) {
            const Vec3 node(8 * i + n % 8, 8 * j + n / 8 % 8, 8 * k + n / 64);
            const double um = 1e6 * height_of_cut(grid.lo + cell_m * node);
            nodes[static_cast<std::size_t>(n)] =
                static_cast<std::int16_t>(std::clamp(std::round(um), -3e4, 3e4));
          }
          EXPECT_TRUE(out.set(block++, nodes));
        }
    return out;
  }
};

}  // namespace osteon::test
