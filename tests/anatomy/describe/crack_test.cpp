#include <gtest/gtest.h>

#include <cmath>

#include "describe/shape.h"
#include "osteon/base/random.h"

namespace osteon {
namespace {

Crack sample() {
  Crack crack;
  crack.point = Vec3(0.01, -0.02, 0.003);
  crack.normal = Vec3(0.6, 0, 0.8);
  crack.gap = 0.002;
  crack.rough = 0.0004;
  crack.grain = 0.002;
  return crack;
}

TEST(CrackShape, WithoutRoughnessIsASlab) {
  Crack flat = sample();
  flat.rough = 0;
  for (const double off : {-0.003, -0.001, 0.0, 0.0005, 0.004}) {
    const Vec3 p = flat.point + off * flat.normal + Vec3(0, 0.007, 0);
    EXPECT_NEAR(distance(flat, p), std::abs(off) - 0.001, 1e-15);
  }
  EXPECT_TRUE(bounds(Primitive(flat)).empty());
}

/// Along the normal the slit is as wide as its gap everywhere, and it strays from the plane.
TEST(CrackShape, IsAsWideAsItsGapWhereverItRuns) {
  const Crack crack = sample();
  Random random(4);
  double farthest = 0;
  for (int i = 0; i < 200; ++i) {
    Vec3 across = random.direction();
    across -= crack.normal.dot(across) * crack.normal;
    const Vec3 base = crack.point + 0.01 * across;
    double first = 1, last = -1;
    for (int k = -200; k <= 200; ++k) {
      const double off = 1e-5 * k;
      if (distance(crack, base + off * crack.normal) > 0) continue;
      first = std::min(first, off);
      last = std::max(last, off);
    }
    EXPECT_NEAR(last - first, crack.gap, 3e-5);
    farthest = std::max(farthest, std::abs(0.5 * (first + last)));
  }
  EXPECT_GT(farthest, 0.3 * crack.rough);
  EXPECT_LE(farthest, crack.rough + 2e-5);
}

/// Grids skip what the value places clear of the surface, so it must never be more than the
/// distance: no two places may differ by more than they lie apart.
TEST(CrackShape, ItsValueNeverChangesFasterThanThePlace) {
  const Crack crack = sample();
  Random random(5);
  for (int i = 0; i < 2000; ++i) {
    const Vec3 p = crack.point + 0.004 * random.direction() * random.uniform(0, 1);
    const Vec3 step = random.uniform(0, 0.0005) * random.direction();
    EXPECT_LE(std::abs(distance(crack, p + step) - distance(crack, p)), step.norm() * (1 + 1e-9));
  }
}

}  // namespace
}  // namespace osteon
