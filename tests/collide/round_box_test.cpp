#include "osteon/collide/round_box.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "osteon/base/random.h"

namespace osteon {
namespace {

constexpr double kRoundest = 0.0005;

// Nearest points of two convex cores by projecting to and fro (Cheney and Goldstein, 1959): it
// shares nothing with the search but the shapes.
double slow_distance(const RoundBox& a, const RoundBox& b) {
  const auto onto = [](const RoundBox& box, const Vec3& p) -> Vec3 {
    if (!box.is_box) {
      const Vec3 d = box.rod.p1 - box.rod.p0;
      const double dd = d.squaredNorm();
      const double t = dd > 0 ? std::clamp(d.dot(p - box.rod.p0) / dd, 0.0, 1.0) : 0;
      return box.rod.p0 + t * d;
    }
    const Vec3 q = box.X.inverse() * p;
    return box.X * Vec3(q.cwiseMax(-box.half).cwiseMin(box.half));
  };
  Vec3 p = middle_of(a), q = middle_of(b);
  for (int i = 0; i < 4000; ++i) {
    q = onto(b, p);
    p = onto(a, q);
  }
  return (p - q).norm();
}

Vec3 vector_of(Random& random, double size) { return random.uniform(0, size) * random.direction(); }

RoundBox shape_of(Random& random) {
  const double kind = random.uniform();
  const Vec3 middle = vector_of(random, 0.02);
  if (kind < 0.3) {
    const Vec3 along = vector_of(random, 0.03);
    return round_box(Capsule{middle - along, middle + along, random.uniform(0.0005, 0.004)});
  }
  Vec3 half;
  for (int k = 0; k < 3; ++k) half[k] = std::exp(random.uniform(std::log(2e-4), std::log(0.02)));
  const Quat q = random.rotation();
  return round_box(make_box({middle, q}, half));
}

TEST(RoundBox, ABallIsABall) {
  const RoundBox ball = round_box(make_rod(Vec3(1, 2, 3), Vec3(1, 2, 3), 0.5));
  EXPECT_FALSE(ball.is_box);
  EXPECT_EQ(highest(ball, Vec3::UnitX()), 1.5);
  EXPECT_EQ(lowest(ball, Vec3::UnitX()), 0.5);
  EXPECT_EQ(reach_of(ball), 0.5);
}

TEST(RoundBox, FacesStayAndEdgesAreRounded) {
  const Vec3 half(0.010, 0.0002, 0.004);
  const RoundBox plate = round_box(make_box({Vec3(0, 0, 0.1), Quat::Identity()}, half));
  EXPECT_NEAR(highest(plate, Vec3::UnitX()), half.x(), 1e-15);
  EXPECT_NEAR(highest(plate, Vec3::UnitY()), half.y(), 1e-15);
  EXPECT_NEAR(lowest(plate, Vec3::UnitZ()), 0.1 - half.z(), 1e-15);
  EXPECT_EQ(plate.rod.radius, 0.0002);
  const Vec3 over_edge = Vec3(1, 1, 0).normalized();
  const double sharp = over_edge.dot(half);
  EXPECT_NEAR(highest(plate, over_edge), sharp - 0.0002 * (std::sqrt(2) - 1), 1e-15);
  const RoundBox block = round_box(make_box({}, Vec3::Constant(0.004)));
  EXPECT_EQ(block.rod.radius, kRoundest);
  EXPECT_NEAR(highest(block, Vec3::UnitY()), 0.004, 1e-15);
}

TEST(RoundBox, CoresThatMeetHaveNothingBetweenThem) {
  const RoundBox a = round_box(make_box({}, Vec3::Constant(0.004)));
  const RoundBox b =
      round_box(make_box({Vec3(0.005, 0, 0), Quat::Identity()}, {0.004, 0.001, 0.02}));
  const RoundBox rod = round_box(make_rod(Vec3(-1, 0, 0), Vec3(1, 0, 0), 0.001));
  for (const AxisPoints& met :
       {nearest_on_cores(a, b), nearest_on_cores(a, rod), nearest_on_cores(rod, a)})
    EXPECT_LT((met.a - met.b).norm(), 1e-12);
}

TEST(RoundBox, ARodOverAFaceIsItsHeightAway) {
  const RoundBox block = round_box(make_box({}, Vec3(0.01, 0.02, 0.003)));
  for (const double tilt : {0.0, 0.2}) {
    const RoundBox rod = round_box(
        make_rod(Vec3(-0.05, 0, 0.006 + 0.05 * tilt), Vec3(0.004, 0, 0.006 - 0.004 * tilt), 1e-3));
    const AxisPoints line = nearest_on_cores(rod, block);
    EXPECT_NEAR(line.a.z() - line.b.z(), 0.006 - 0.004 * tilt - 0.0025, 1e-12) << tilt;
    EXPECT_LT((line.a - line.b).head<2>().norm(), 1e-12) << tilt;
  }
}

// Three thousand pairs of balls, rods and boxes, thin and thick; both orders say the same.
TEST(RoundBox, NearestPointsAreThoseOfASlowSearch) {
  Random random(3);
  int apart = 0;
  for (int i = 0; i < 3000; ++i) {
    RoundBox a = shape_of(random), b = shape_of(random);
    const Pose moved{vector_of(random, 0.05), random.rotation()};
    b = placed(moved, b);
    const AxisPoints line = nearest_on_cores(a, b), back = nearest_on_cores(b, a);
    const double distance = (line.a - line.b).norm();
    ASSERT_NEAR(distance, (back.a - back.b).norm(), 1e-12) << i;
    const double slow = slow_distance(a, b);
    ASSERT_LE(distance, slow + 1e-12) << i;
    ASSERT_GE(distance, slow - 1e-5)
        << i;  // the slow one ends late where faces meet at a small angle
    if (!(distance > 1e-6)) continue;
    ++apart;
    // What lies between is a separating plane of both.
    const Vec3 n = (line.a - line.b) / distance;
    ASSERT_NEAR(lowest(a, n) - highest(b, n), distance - a.rod.radius - b.rod.radius, 1e-12) << i;
    ASSERT_LT((n + (back.a - back.b) / distance).norm(), 1e-6) << i;
    for (const RoundBox* shape : {&a, &b})
      ASSERT_LE(std::abs(n.dot(middle_of(*shape)) - highest(*shape, n)), reach_of(*shape) + 1e-12);
  }
  EXPECT_GT(apart, 1500);
}

// A core of 2 x 4 x 6 about `middle`; the line goes along x from 0 to 10, and up is z.
OverLine over(const Vec3& middle, const Quat& q = Quat::Identity()) {
  RoundBox box = round_box(make_box({middle, q}, Vec3(1, 2, 3)));
  box.half = Vec3(1, 2, 3);
  return lowest_over(box, Vec3::Zero(), Vec3(10, 0, 0), Vec3::UnitZ());
}

TEST(OverLine, ABoxBesideItsPlaneOrBeyondItsEndsDoesNotMeetIt) {
  EXPECT_FALSE(over(Vec3(5, 2.01, 7)).meets);
  EXPECT_FALSE(over(Vec3(-1.01, 0, 7)).meets);
  EXPECT_FALSE(over(Vec3(11.01, 0, 7)).meets);
  EXPECT_TRUE(over(Vec3(5, 1.99, 7)).meets);
}

TEST(OverLine, TheHeightIsThatOfTheLowestPlaceAboveAndUnderTheLine) {
  for (const double z : {7.0, 3.0, 0.0, -9.0}) {
    const OverLine flat = over(Vec3(4, 1, z));
    ASSERT_TRUE(flat.meets);
    EXPECT_NEAR(flat.height, z - 3, 1e-12);
    EXPECT_NEAR(flat.share, 0.4, 1e-9) << "the middle of the face";
  }
}

// Turned by 45 degrees about the line's plane's normal, on a corner: (1 + 3) / sqrt 2 down, and
// (3 - 1) / sqrt 2 aside.
TEST(OverLine, ABoxOnItsCornerIsLowestThere) {
  const Quat turn(Eigen::AngleAxisd(3.14159265358979 / 4, Vec3::UnitY()));
  const OverLine corner = over(Vec3(5, 0, 7), turn);
  ASSERT_TRUE(corner.meets);
  EXPECT_NEAR(corner.height, 7 - 4 / std::sqrt(2.0), 1e-9);
  EXPECT_NEAR(std::abs(corner.share - 0.5), 2 / std::sqrt(2.0) / 10, 1e-4);
}

// The corner hangs out beyond the line's end: the lowest place over the line is on the way up.
TEST(OverLine, WhatHangsOutBeyondTheEndDoesNotCount) {
  const Quat turn(Eigen::AngleAxisd(3.14159265358979 / 4, Vec3::UnitY()));
  const double aside = 2 * (over(Vec3(5, 0, 7), turn).share - 0.5) * 5;  // of the lowest corner
  const double end = aside > 0 ? 10 : 0, beyond = 0.25;
  const double x = end - aside + (aside > 0 ? beyond : -beyond);
  const OverLine cut = over(Vec3(x, 0, 7), turn);
  ASSERT_TRUE(cut.meets);
  EXPECT_NEAR(cut.height, 7 - 4 / std::sqrt(2.0) + beyond, 1e-3);
  EXPECT_NEAR(cut.share, end / 10, 1e-3);
}

}  // namespace
}  // namespace osteon
