#include "osteon/device/safety_limits.h"

#include <gtest/gtest.h>

#include <cmath>

namespace osteon {
namespace {

TEST(ClampedNorm, KeepsDirectionAndSurvivesHugeForces) {
  EXPECT_EQ(clamped_norm(Vec3::Zero(), 8), Vec3(Vec3::Zero()));
  EXPECT_EQ(clamped_norm(Vec3(1, 2, 3), 0), Vec3(Vec3::Zero()));
  EXPECT_EQ(clamped_norm(Vec3(3, 0, -4), 8), Vec3(3, 0, -4));
  EXPECT_LT((clamped_norm(Vec3(30, 0, -40), 5) - Vec3(3, 0, -4)).norm(), 1e-12);
  EXPECT_LE(clamped_norm(Vec3(1e300, -1e300, 1e300), 8).norm(), 8);
}

TEST(SlewLimit, BoundsTheChangeAndCountsFromWhatWasSettled) {
  SlewLimit slew(1000);
  EXPECT_EQ(slew.next(Vec3(5, 0, 0), 0), Vec3(Vec3::Zero()));
  EXPECT_NEAR(slew.next(Vec3(5, 0, 0), 0.001).x(), 1, 1e-12);
  EXPECT_NEAR(slew.next(Vec3(1.5, 0, 0), 0.001).x(), 1.5, 1e-12);
  slew.settle(Vec3(0.2, 0, 0));
  EXPECT_NEAR(slew.next(Vec3(5, 0, 0), 0.001).x(), 1.2, 1e-12);
}

TEST(ForceBudget, WithoutAContinuousForceItIsThePeakForEver) {
  for (const double continuous : {0.0, -1.0, 8.0, 9.0}) {
    ForceBudget budget(8, continuous, 5);
    for (int i = 0; i < 60000; ++i) budget.spend(Vec3(8, 0, 0), 0.001);
    EXPECT_EQ(budget.limit_n(), 8);
    EXPECT_EQ(budget.heat(), 0);
  }
}

TEST(ForceBudget, HeatRisesByTheLawOfOneTimeConstantAndTheLimitFollows) {
  ForceBudget budget(8, 2, 5);
  for (int i = 0; i < 5000; ++i) budget.spend(Vec3(0, 2, 0), 0.001);
  EXPECT_NEAR(budget.heat(), 1 - std::exp(-1.0), 1e-3);  // of 2 N held for one time constant
  EXPECT_EQ(budget.limit_n(), 8);
  for (int i = 0; i < 50000; ++i) budget.spend(Vec3(0, 2, 0), 0.001);
  EXPECT_NEAR(budget.limit_n(), 2, 0.01);  // what they bear for ever is the limit in the end
  for (int i = 0; i < 50000; ++i) budget.spend(Vec3::Zero(), 0.001);
  EXPECT_EQ(budget.limit_n(), 8);
}

}  // namespace
}  // namespace osteon
