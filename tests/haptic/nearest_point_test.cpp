#include "nearest_point.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "osteon/base/random.h"

namespace osteon {
namespace {

double worst_shortfall(const std::vector<FreeHalfSpace>& planes, const Vec3& x) {
  double worst = -1e300;
  for (const FreeHalfSpace& p : planes) worst = std::max(worst, p.c - p.n.dot(x));
  return worst;
}

// Nearest feasible point by Hildreth's cyclic dual ascent (1957): slow, simple, independent.
Vec3 hildreth(const std::vector<FreeHalfSpace>& planes, const Vec3& wanted) {
  std::vector<double> w(planes.size(), 0);
  Vec3 x = wanted;
  for (int sweep = 0; sweep < 20000; ++sweep) {
    double change = 0;
    for (std::size_t i = 0; i < planes.size(); ++i) {
      const double next = std::max(0.0, w[i] + planes[i].c - planes[i].n.dot(x));
      x += (next - w[i]) * planes[i].n;
      change = std::max(change, std::abs(next - w[i]));
      w[i] = next;
    }
    if (change < 1e-14) break;
  }
  return x;
}

TEST(NearestPoint, WithoutPlanesItIsTheWantedOne) {
  const NearestPoint p = nearest_point({}, Vec3(1, 2, 3));
  EXPECT_TRUE(p.found);
  EXPECT_EQ(p.x, Vec3(1, 2, 3));
  EXPECT_EQ(p.active_count, 0u);
}

TEST(NearestPoint, OnePlane) {
  const std::vector<FreeHalfSpace> planes{{Vec3::UnitZ(), 0.5}};
  const NearestPoint p = nearest_point(planes, Vec3(1, 2, 0.2));
  ASSERT_TRUE(p.found);
  EXPECT_LT((p.x - Vec3(1, 2, 0.5)).norm(), 1e-15);
  ASSERT_EQ(p.active_count, 1u);
  EXPECT_NEAR(p.weight[0], 0.3, 1e-15);
}

TEST(NearestPoint, TheSamePlaneTwiceAndAlmostTwice) {
  for (const double tilt : {0.0, 1e-12, 1e-8, 1e-4}) {
    const Vec3 n = Vec3(tilt, 0, 1).normalized();
    const std::vector<FreeHalfSpace> planes{
        {Vec3::UnitZ(), 0.005}, {n, 0.005}, {Vec3::UnitZ(), 0.005}};
    const NearestPoint p = nearest_point(planes, Vec3(0.001, 0, 0));
    ASSERT_TRUE(p.found) << tilt;
    EXPECT_NEAR(p.x.z(), 0.005, 1e-6) << tilt;
    EXPECT_LE(worst_shortfall(planes, p.x), kPlaneTolerance) << tilt;
  }
}

TEST(NearestPoint, SaysWhenThereIsNoCommonPoint) {
  EXPECT_FALSE(
      nearest_point(std::vector<FreeHalfSpace>{{Vec3::UnitX(), 0.001}, {-Vec3::UnitX(), 0}},
                    Vec3::Zero())
          .found);
  // Four faces of a tetrahedron, seen from inside out: empty only all together.
  std::vector<FreeHalfSpace> planes;
  for (const Vec3& n : {Vec3(1, 1, 1), Vec3(1, -1, -1), Vec3(-1, 1, -1), Vec3(-1, -1, 1)})
    planes.push_back({n.normalized(), 0.001});
  EXPECT_FALSE(nearest_point(planes, Vec3(0.0003, 0.0001, 0)).found);
  planes.pop_back();
  EXPECT_TRUE(nearest_point(planes, Vec3(0.0003, 0.0001, 0)).found);
}

TEST(NearestPoint, AgreesWithHildrethAndMeetsTheOptimalityConditions) {
  Random random(17);
  int three = 0;
  for (int trial = 0; trial < 3000; ++trial) {
    std::vector<FreeHalfSpace> planes;
    const int count = 1 + static_cast<int>(random.uniform(0, 12));
    for (int i = 0; i < count; ++i) {
      const Vec3 n = random.direction();
      planes.push_back({n, random.uniform(-0.003, 0)});  // the origin is free
    }
    const double far = random.uniform(0, 0.01);
    const Vec3 wanted = far * random.direction();
    const NearestPoint p = nearest_point(planes, wanted);
    ASSERT_TRUE(p.found);
    ASSERT_LE(worst_shortfall(planes, p.x), kPlaneTolerance);
    Vec3 sum = wanted;
    for (std::uint32_t i = 0; i < p.active_count; ++i) {
      ASSERT_GT(p.weight[i], 0);
      ASSERT_NEAR(planes[p.active[i]].n.dot(p.x), planes[p.active[i]].c, 1e-12);
      sum += p.weight[i] * planes[p.active[i]].n;
    }
    ASSERT_LT((sum - p.x).norm(), 1e-12);
    const Vec3 oracle = hildreth(planes, wanted);
    if (worst_shortfall(planes, oracle) < 1e-10) {
      ASSERT_LT((oracle - p.x).norm(), 1e-7);
    }
    three += p.active_count == 3;
  }
  EXPECT_GT(three, 100);
}

}  // namespace
}  // namespace osteon
