#include "bones_age.h"

#include <gtest/gtest.h>

namespace osteon {
namespace {

TEST(BonesAge, IsTheTimeSinceTheSnapshotWhenTheClocksKeepStep) {
  // Two ticks a step: tick n consumes step (n - 1) / 2, which ended with tick 2 step.
  BonesAge age;
  for (std::uint64_t n = 1; n <= 100; ++n) {
    const std::uint64_t step = (n - 1) / 2;
    EXPECT_DOUBLE_EQ(age.at(n, step, 0.001), 0.001 * double(n - 2 * step)) << n;
  }
}

TEST(BonesAge, GrowsToItsLimitWhenPhysicsStops) {
  BonesAge age;
  EXPECT_DOUBLE_EQ(age.at(1, 5, 0.001), 0.001);
  EXPECT_DOUBLE_EQ(age.at(15, 5, 0.001), 0.015);
  EXPECT_DOUBLE_EQ(age.at(20, 5, 0.001), 0.020);
  EXPECT_DOUBLE_EQ(age.at(1000, 5, 0.001), 0.020);
  EXPECT_DOUBLE_EQ(age.at(1001, 6, 0.001), 0.001);
}

TEST(BonesAge, DoesNotDriftWithTheClocks) {
  // Physics at a third of its due rate, then at three times it.
  BonesAge age;
  for (std::uint64_t n = 1; n <= 600; ++n) EXPECT_LE(age.at(n, n / 6, 0.001), 0.0061);
  for (std::uint64_t n = 601; n <= 900; ++n)
    EXPECT_DOUBLE_EQ(age.at(n, 100 + 3 * (n - 600), 0.001), 0.001);
}

}  // namespace
}  // namespace osteon
