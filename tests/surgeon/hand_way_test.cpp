#include "hand_way.h"

#include <gtest/gtest.h>

#include <cmath>

#include "osteon/base/random.h"

namespace osteon {
namespace {

double nearest_rad(const std::vector<Vec3>& way, const std::vector<Vec3>& bones) {
  double least = 4;
  for (const Vec3& at : way)
    for (const Vec3& bone : bones) least = std::min(least, std::acos(at.dot(bone)));
  return least;
}

TEST(WayRound, WithoutBonesItIsStraight) {
  const auto way = way_round(Vec3::UnitX(), Vec3::UnitY(), {});
  ASSERT_FALSE(way.empty());
  EXPECT_LT((way.back() - Vec3::UnitY()).norm(), 1e-12);
  for (const Vec3& at : way) {
    EXPECT_NEAR(at.norm(), 1, 1e-12);
    EXPECT_NEAR(at.z(), 0, 1e-12);
  }
}

TEST(WayRound, FromAPlaceToItselfAndToTheOtherSideItArrives) {
  const std::vector<Vec3> bones{Vec3(1, 1, 0).normalized()};
  for (const Vec3& to : {Vec3(1, 0, 0), Vec3(-1, 0, 0), Vec3(-0.999, 0.01, 0)}) {
    const auto way = way_round(Vec3::UnitX(), to.normalized(), bones);
    ASSERT_FALSE(way.empty());
    EXPECT_LT((way.back() - to.normalized()).norm(), 1e-9);
    for (const Vec3& at : way) EXPECT_TRUE(at.allFinite());
  }
}

// A bone in the middle of the straight way: it goes round by more than 35 degrees.
TEST(WayRound, ABoneOnTheStraightWayIsPassedFarOff) {
  Random random(4);
  for (int i = 0; i < 50; ++i) {
    const Vec3 from = random.direction(), to = random.direction();
    if (from.dot(to) > 0 || from.dot(to) < -0.95) continue;
    const std::vector<Vec3> bones{(from + to).normalized()};
    EXPECT_GT(nearest_rad(way_round(from, to, bones), bones), 0.6) << i;
  }
}

}  // namespace
}  // namespace osteon
