#include "friction.h"

#include <gtest/gtest.h>

#include <vector>

namespace osteon {
namespace {

// A path of 3 mm with a corner after 2 mm.
const std::vector<Vec3> kPath{Vec3(0, 0, 0), Vec3(0.002, 0, 0), Vec3(0.002, 0.001, 0)};

TEST(Friction, WithoutRatioTheProxyGoesAllTheWay) {
  const FrictionStep s = apply_friction(kPath, {0, 0, 1}, true);
  EXPECT_EQ(s.p_W, kPath.back());
  EXPECT_FALSE(s.sticking);
  EXPECT_FALSE(s.sliding);
}

TEST(Friction, AtRestTheStaticLagDecides) {
  EXPECT_TRUE(apply_friction(kPath, {0.0031, 0.001, 1}, false).sticking);
  EXPECT_EQ(apply_friction(kPath, {0.0031, 0.001, 1}, false).p_W, kPath.front());
  const FrictionStep s = apply_friction(kPath, {0.0029, 0.001, 1}, false);
  EXPECT_TRUE(s.sliding);
  EXPECT_LT((s.p_W - kPath[1]).norm(), 1e-12);  // 1 mm before the end, along the path
}

TEST(Friction, SlidingTheDynamicLagDecides) {
  const FrictionStep s = apply_friction(kPath, {0.01, 0.0015, 1}, true);
  EXPECT_TRUE(s.sliding);
  EXPECT_LT((s.p_W - Vec3(0.0015, 0, 0)).norm(), 1e-12);
  EXPECT_TRUE(apply_friction(kPath, {0.01, 0.0031, 1}, true).sticking);
}

TEST(Friction, ADynamicRatioAboveTheStaticOneCountsAsTheStaticOne) {
  const FrictionStep s = apply_friction(kPath, {0.001, 0.005, 1}, false);
  EXPECT_LT((s.p_W - kPath[1]).norm(), 1e-12);
}

TEST(Friction, OneStepGlidesByItsLimitAndATwentiethOfTheWay) {
  const FrictionStep s = apply_friction(kPath, {0, 0, 0.0001}, false);
  EXPECT_LT((s.p_W - Vec3(0.00025, 0, 0)).norm(), 1e-12);
  // Repeated, it arrives.
  std::vector<Vec3> path = kPath;
  int steps = 0;
  while ((path.front() - path.back()).norm() > 0 && steps < 100) {
    path.front() = apply_friction(path, {0, 0, 0.0001}, false).p_W;
    if (path.size() == 3 && path.front().x() >= 0.002 - 1e-12) path.erase(path.begin() + 1);
    ++steps;
  }
  EXPECT_LT(steps, 30);
}

TEST(Friction, APathOfOnePointStays) {
  const std::vector<Vec3> point{Vec3(1, 2, 3)};
  EXPECT_EQ(apply_friction(point, {0.001, 0.001, 1}, true).p_W, point[0]);
  EXPECT_EQ(apply_friction(point, {0, 0, 1}, true).p_W, point[0]);
}

}  // namespace
}  // namespace osteon
