#include "osteon/collide/field_contact.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "mesh/shapes.h"
#include "osteon/base/random.h"

namespace osteon {
namespace {

constexpr double kBallRadius = 0.004;

const DistanceField& felt_ball() {
  static const DistanceField field =
      std::move(DistanceField::make(test::sphere(kBallRadius, 40)).value());
  return field;
}

TEST(FieldContact, WhatIsNotFiniteIsNoContact) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const Vec3 p(0.009, 0, 0);
  for (const Capsule& c : {Capsule{Vec3(nan, 0, 0), p, 0.001}, Capsule{p, Vec3(0, nan, 0), 0.001},
                           Capsule{p, p, nan}, Capsule{p, p, -1}})
    EXPECT_NE(field_contact(felt_ball(), c).status, LpStatus::kOptimal);
}

TEST(FieldContact, ABallStandsOffByItsRadius) {
  Random random(1);
  for (int i = 0; i < 200; ++i) {
    const Vec3 n = random.direction();
    const double h = 0.0008 * random.uniform();
    const Vec3 p = (kBallRadius + h) * n;
    const CapsuleContact c = field_contact(felt_ball(), {p, p, 0.0005});
    ASSERT_EQ(c.status, LpStatus::kOptimal);
    EXPECT_NEAR(c.gap, h - 0.0005, 1e-5);
    EXPECT_GT(c.nhat_AB_A.dot(n), 0.998);
    EXPECT_LT((c.p_A - kBallRadius * n).norm(), 5e-5);
    EXPECT_EQ(c.p_axis_A, p);
  }
}

TEST(FieldContact, ABoxStandsOffByItsFaceAndARodAsItsCapsule) {
  const Vec3 half(0.01, 0.006, 0.00075);
  const RoundBox flat = placed({Vec3(0.001, 0, kBallRadius + 0.001), Quat::Identity()},
                               round_box(make_box({}, half)));
  const CapsuleContact c = round_contact(felt_ball(), flat);
  ASSERT_EQ(c.status, LpStatus::kOptimal);
  EXPECT_NEAR(c.gap, 0.001 - half.z(), 1e-5);
  EXPECT_GT(c.nhat_AB_A.z(), 0.998);
  EXPECT_LT((c.p_A - Vec3(0, 0, kBallRadius)).norm(), 1e-4);
  EXPECT_NEAR(c.p_axis_A.z(), kBallRadius + 0.001 - half.z() + flat.rod.radius, 1e-12);
  const Capsule rod{Vec3(0.004, 0, 0.004), Vec3(-0.004, 0.001, 0.0045), 0.0005};
  EXPECT_EQ(round_contact(felt_ball(), round_box(rod)).gap, field_contact(felt_ball(), rod).gap);
  RoundBox lost = flat;
  lost.X.p.x() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_NE(round_contact(felt_ball(), lost).status, LpStatus::kOptimal);
}

TEST(FieldContact, FarAwayTheGapIsABound) {
  const Vec3 p(0.05, 0.02, 0);
  const CapsuleContact c = field_contact(felt_ball(), {p, p, 0.001});
  ASSERT_EQ(c.status, LpStatus::kOptimal);
  EXPECT_GT(c.gap, 0.03);
  EXPECT_LE(c.gap, p.norm() - kBallRadius - 0.001);
}

// Oracle: the field at ten thousand places of the axis.
TEST(FieldContact, ARodTouchesWhereItsAxisIsLowest) {
  Random random(2);
  for (int i = 0; i < 40; ++i) {
    const Vec3 n = random.direction();
    const Vec3 middle = (kBallRadius + 0.0006) * n;
    const Vec3 any = 0.003 * random.direction();
    const Vec3 way = any - 0.97 * any.dot(n) * n;
    const Capsule rod{middle - 0.3 * way, middle + 0.7 * way, 0.0005};
    const CapsuleContact c = field_contact(felt_ball(), rod);
    ASSERT_EQ(c.status, LpStatus::kOptimal);
    double lowest = 1e9;
    for (int k = 0; k <= 10000; ++k)
      lowest = std::min(lowest, felt_ball().at(rod.p0 + (k / 10000.0) * way).distance);
    EXPECT_NEAR(c.gap, lowest - rod.radius, 5e-7) << i;
  }
}

// A rod over the rim of a cup touches in two places; the deeper one is found whichever it is.
TEST(FieldContact, OfTwoLowPlacesTheLowerIsFound) {
  const TriMesh two = test::joined(test::cube(0.003, Vec3(-0.006, 0, 0)),
                                   test::cube(0.003, Vec3(0.006, 0, 0.0002)));
  const auto field = DistanceField::make(two);
  ASSERT_TRUE(field);
  const Capsule rod{Vec3(-0.008, 0, 0.0038), Vec3(0.008, 0, 0.0038), 0.0005};
  const CapsuleContact c = field_contact(*field, rod);
  ASSERT_EQ(c.status, LpStatus::kOptimal);
  EXPECT_NEAR(c.gap, 0.0001, 1e-5);  // a sharp edge rings a little
  EXPECT_GT(c.p_axis_A.x(), 0.002);
}

TEST(FieldContact, TheGapIsContinuousAlongAPath) {
  double last = 1;
  Vec3 normal = Vec3::Zero();
  for (int i = 0; i < 4000; ++i) {
    const Vec3 p(-0.002 + 1e-6 * i, 0.0005, 0.0043);
    const CapsuleContact c = field_contact(felt_ball(), {p, p, 0.00075});
    ASSERT_EQ(c.status, LpStatus::kOptimal);
    if (i > 0) {
      EXPECT_LT(std::abs(c.gap - last), 1.2e-6);
      EXPECT_LT((c.nhat_AB_A - normal).norm(), 0.001);
    }
    last = c.gap;
    normal = c.nhat_AB_A;
  }
}

}  // namespace
}  // namespace osteon
