// Whole numbers in four lanes, and the sum of splines over them against a plain sum.
#include "four_lanes.h"

#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <random>

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
  SplineRows rows;
  for (std::size_t i = 0; i < rows.row.size(); ++i) rows.row[i] = h.data() + 4 * i;
  const SplineSum found = sum_splines(rows, {0.3, 0.85, 0});
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

// What a replay on another computer rests on.
TEST(SplineSum, HasTheSameBitsInRegistersOfEveryWidth) {
  std::mt19937 random(7);
  std::uniform_int_distribution<int> height(-32768, 32767);
  std::uniform_real_distribution<double> place(0, 1);
  for (int round = 0; round < 2000; ++round) {
    std::array<std::int16_t, 64> h{};
    for (std::int16_t& one : h) one = static_cast<std::int16_t>(height(random));
    SplineRows rows;
    for (std::size_t i = 0; i < rows.row.size(); ++i) rows.row[i] = h.data() + 4 * i;
    if (round % 2 == 1) rows.most = static_cast<std::int16_t>(height(random));
    const Vec3 t(round % 5 == 0 ? 0 : place(random), place(random), place(random));
    const SplineSum wide = sum_splines(rows, t), narrow = sum_splines_narrow(rows, t);
    ASSERT_EQ(std::bit_cast<std::uint64_t>(wide.value), std::bit_cast<std::uint64_t>(narrow.value));
    for (const double value : {value_of_splines(rows, t), value_of_splines_narrow(rows, t)})
      ASSERT_EQ(std::bit_cast<std::uint64_t>(value), std::bit_cast<std::uint64_t>(wide.value));
    for (int i = 0; i < 3; ++i)
      ASSERT_EQ(std::bit_cast<std::uint64_t>(wide.slope[i]),
                std::bit_cast<std::uint64_t>(narrow.slope[i]));
  }
}

}  // namespace
}  // namespace osteon
