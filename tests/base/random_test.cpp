#include "osteon/base/random.h"

#include <gtest/gtest.h>

#include <cmath>

namespace osteon {
namespace {

// First outputs of SplitMix64 for the seed 1234567, as published with its reference code.
TEST(Random, AgreesWithThePublishedStream) {
  Random r(1234567);
  EXPECT_EQ(r.next(), 6457827717110365317ull);
  EXPECT_EQ(r.next(), 3203168211198807973ull);
  EXPECT_EQ(r.next(), 9817491932198370423ull);
}

TEST(Random, UniformStaysInItsRangeAndHasItsMean) {
  Random r(1);
  double sum = 0;
  for (int i = 0; i < 100000; ++i) {
    const double u = r.uniform(-2, 6);
    ASSERT_GE(u, -2);
    ASSERT_LT(u, 6);
    sum += u;
  }
  EXPECT_NEAR(sum / 100000, 2.0, 0.03);  // 4 standard errors
}

TEST(Random, NormalHasItsMeanAndDeviation) {
  Random r(2);
  double sum = 0, sum2 = 0;
  constexpr int kN = 100000;
  for (int i = 0; i < kN; ++i) {
    const double x = r.normal(5, 2);
    sum += x;
    sum2 += (x - 5) * (x - 5);
  }
  EXPECT_NEAR(sum / kN, 5, 0.03);
  EXPECT_NEAR(std::sqrt(sum2 / kN), 2, 0.03);
}

TEST(Random, DirectionsAreUnitAndBalanced) {
  Random r(3);
  Vec3 sum = Vec3::Zero();
  for (int i = 0; i < 10000; ++i) {
    const Vec3 d = r.direction();
    ASSERT_NEAR(d.norm(), 1, 1e-12);
    sum += d;
  }
  EXPECT_LT((sum / 10000).norm(), 0.04);
}

TEST(Random, RotationsAreUnitAndTurnVectorsEverywhere) {
  Random r(4);
  Vec3 sum = Vec3::Zero();
  for (int i = 0; i < 10000; ++i) {
    const Quat q = r.rotation();
    ASSERT_NEAR(q.norm(), 1, 1e-12);
    sum += q * Vec3::UnitX();
  }
  EXPECT_LT((sum / 10000).norm(), 0.04);
}

}  // namespace
}  // namespace osteon
