// Whole numbers in four lanes, and the sum of splines over them against a plain sum.
#include "four_lanes.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>

#include "cubic_spline.h"

namespace osteon {
namespace {

std::array<double, 4> values(const FourLanes& four) {
  std::array<double, 4> out{};
  four.lo.store(out.data());
  four.hi.store(out.data() + 2);
  return out;
}

TEST(FourLanes, WholeNumbersKeepTheirSignAndTheirBound) {
  const std::array<std::int16_t, 5> from{-32768, -1, 0, 32767, 77};
  EXPECT_EQ(values(FourLanes::load(from.data())), (std::array<double, 4>{-32768, -1, 0, 32767}));
  EXPECT_EQ(values(FourLanes::load(from.data() + 1)), (std::array<double, 4>{-1, 0, 32767, 77}));
  EXPECT_EQ(values(FourLanes::load(from.data(), 5)), (std::array<double, 4>{-32768, -1, 0, 5}));
  EXPECT_EQ(values(FourLanes::load(from.data(), -7)), (std::array<double, 4>{-32768, -7, -7, -7}));
}

TEST(FourLanes, SumsInOneOrder) {
  const std::array<double, 4> a{1e16, 3, -1e16, 5}, b{1, 1, 1, 1};
  EXPECT_EQ(FourLanes::load(a.data()).dot(FourLanes::load(b.data())), (1e16 + -1e16) + (3.0 + 5.0));
}

TEST(SplineSum, IsTheTensorProduct) {
  const CubicSpline x(0.3), y(0.85), z(0);
  std::array<std::int16_t, 64> h{};
  for (std::size_t i = 0; i < h.size(); ++i)
    h[i] = static_cast<std::int16_t>(static_cast<int>(i * 7919 % 4001) - 2000);
  const SplineSum found = sum_splines(
      [&](std::size_t j, std::size_t k) { return FourLanes::load(h.data() + 16 * k + 4 * j); }, x,
      y, z);
  double value = 0;
  Vec3 slope = Vec3::Zero();
  for (std::size_t k = 0; k < 4; ++k)
    for (std::size_t j = 0; j < 4; ++j)
      for (std::size_t i = 0; i < 4; ++i) {
        const double at = h[16 * k + 4 * j + i];
        value += x.w[i] * y.w[j] * z.w[k] * at;
        slope +=
            Vec3(x.d[i] * y.w[j] * z.w[k], x.w[i] * y.d[j] * z.w[k], x.w[i] * y.w[j] * z.d[k]) * at;
      }
  EXPECT_NEAR(found.value, value, 1e-9);
  EXPECT_LT((found.slope - slope).norm(), 1e-9);
}

}  // namespace
}  // namespace osteon
