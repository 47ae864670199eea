#include "near_search.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "osteon/base/random.h"
#include "shapes.h"

namespace osteon {
namespace {

using shapes::body;

Vec3 within(Random& random, double reach) {
  const double x = random.uniform(-reach, reach), y = random.uniform(-reach, reach);
  return {x, y, random.uniform(-reach, reach)};
}

double excess_of(const ConvexBody& b, std::uint32_t plane, const Vec3& u) {
  return b.normal(plane).dot(u) - b.offset[plane];
}

// What every plane and every vertex gives, looked at one by one.
double most_of_all(const ConvexBody& b, const Vec3& u) {
  double most = -1e300;
  for (std::uint32_t i = 0; i < b.plane_count; ++i) most = std::max(most, excess_of(b, i, u));
  return most;
}
double highest_of_all(const ConvexBody& b, const Vec3& n) {
  double highest = -1e300;
  for (std::uint32_t i = 0; i < b.vertex_count; ++i)
    highest = std::max(highest, b.vertex(i).dot(n));
  return highest;
}

// A stroke in small steps that now and then jumps, with one list all along. Floors lie below, at
// and above what is found, as a programme's levels do.
void expect_same_as_all(const ConvexBody& b, Random& random, double step) {
  NearList planes, vertices;
  Vec3 u = within(random, b.radius), n = random.direction();
  for (int i = 0; i < 2000; ++i) {
    const bool jump = i % 97 == 0;
    u = jump ? within(random, b.radius) : Vec3(u + within(random, step));
    n = (jump ? random.direction() : Vec3(n + within(random, step / b.radius))).normalized();
    const double most = most_of_all(b, u), slack = 1e-15 * b.radius;
    for (const double floor : {most - step, most, most + step}) {
      const Excess found = most_exceeded(b, u, floor, planes);
      ASSERT_EQ(found.plane != Excess::kNone, most_exceeded(b, u, floor).plane != Excess::kNone);
      ASSERT_NEAR(found.value, std::max(most, floor), slack);
      if (found.plane != Excess::kNone) {
        ASSERT_NEAR(excess_of(b, found.plane, u), most, slack);
      }
    }
    list_planes(b, u, most, planes);
    ASSERT_NEAR(support(b, n, vertices), highest_of_all(b, n), slack + 1e-15 * b.center.norm());
    list_vertices(b, n, highest_of_all(b, n), vertices);
  }
}

TEST(NearSearch, MoreEqualPlanesThanAListHolds) {
  // 200 sides that all stand equally far from a point of the axis.
  const ConvexBody cone = body(shapes::cone(200, 0.01, 0.02));
  Random random(3);
  expect_same_as_all(cone, random, 1e-5);
}

TEST(NearSearch, FewerPlanesThanAListHolds) {
  Random random(5);
  expect_same_as_all(body(shapes::box({0.01, 0.02, 0.03})), random, 1e-4);
}

TEST(NearSearch, FindsWhatALookAtAllFindsAlongStrokes) {
  Random random(7);
  const ConvexBody egg = body(shapes::ellipsoid(3, {0.01, 0.015, 0.04}));
  for (const double step : {1e-7, 1e-5, 1e-3}) expect_same_as_all(egg, random, step);
}

TEST(NearSearch, AListOfAnotherBodyChangesNoAnswer) {
  const ConvexBody egg = body(shapes::ellipsoid(3, {0.01, 0.015, 0.04}));
  const ConvexBody ball = body(shapes::ellipsoid(2, {0.01, 0.01, 0.01}));
  Random random(9);
  NearList planes, vertices;
  for (int i = 0; i < 200; ++i) {
    const ConvexBody& b = i % 2 == 0 ? egg : ball;
    const Vec3 u = within(random, 1e-3), n = random.direction();
    const double floor = most_of_all(b, u);
    EXPECT_NEAR(most_exceeded(b, u, floor, planes).value, floor, 1e-17);
    EXPECT_NEAR(support(b, n, vertices), highest_of_all(b, n), 1e-16);
    list_planes(b, u, floor, planes);
    list_vertices(b, n, highest_of_all(b, n), vertices);
  }
}

TEST(NearSearch, AListServesNearbyAndIsDroppedFarOff) {
  const ConvexBody egg = body(shapes::ellipsoid(3, {0.01, 0.015, 0.04}));
  const Vec3 u(0.0099, 0, 0), near_by(0.0099, 1e-5, 0), far_off(0, 0.0149, 0);
  NearList list;
  list_planes(egg, u, most_of_all(egg, u), list);
  EXPECT_GT(list.count, 0u);
  EXPECT_EQ(most_exceeded(egg, near_by, -1, list).plane, most_exceeded(egg, near_by, -1).plane);
  EXPECT_EQ(list.body, egg.stamp);
  EXPECT_EQ(most_exceeded(egg, far_off, -1, list).plane, most_exceeded(egg, far_off, -1).plane);
  EXPECT_EQ(list.body, 0u);
}

}  // namespace
}  // namespace osteon
