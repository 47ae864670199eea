#include "rigid_motion.h"

#include <gtest/gtest.h>

#include <cmath>

#include "osteon/base/random.h"

namespace osteon {
namespace {

TEST(RigidMotion, CarriedForwardFollowsTheExactRotation) {
  Random random(3);
  for (int i = 0; i < 200; ++i) {
    BoneMotion m;
    m.X_WB.q = random.rotation();
    m.X_WB.p = random.direction();
    m.v_W = random.direction();
    const double rate = random.uniform(0, 10);
    const Vec3 axis = random.direction();
    m.w_W = rate * axis;
    const double age = 0.004;
    const Pose X = carried_forward(m, age);
    EXPECT_LT((X.p - m.X_WB.p - age * m.v_W).norm(), 1e-15);
    const Quat exact(Quat(Eigen::AngleAxisd(rate * age, axis)) * m.X_WB.q);
    EXPECT_LE(X.q.angularDistance(exact), std::pow(rate * age, 3) / 12 + 1e-7);
  }
  const BoneMotion still{{Vec3(1, 2, 3), Quat(0.5, 0.5, 0.5, 0.5)}};
  EXPECT_EQ(carried_forward(still, 0.01).p, still.X_WB.p);
  EXPECT_EQ(carried_forward(still, 0.01).q.coeffs(), still.X_WB.q.coeffs());
}

TEST(RigidMotion, TurnsByTheLimitOnTheShortWayThenArrivesExactly) {
  Random random(4);
  for (int i = 0; i < 300; ++i) {
    const Quat to = random.rotation();
    Quat from = random.rotation();
    if (i % 2) from.coeffs() = -from.coeffs();
    double left = from.angularDistance(to);
    for (int k = 0; k < 80; ++k) {
      const Quat next = turned_towards(from, to, 0.05);
      ASSERT_NEAR(next.norm(), 1, 1e-14);
      ASSERT_LE(next.angularDistance(from), 0.05 + 1e-7);
      ASSERT_NEAR(next.angularDistance(to), std::max(0.0, left - 0.05), 1e-6);
      left = next.angularDistance(to);
      from = next;
    }
    EXPECT_EQ(from.coeffs(), to.coeffs());
  }
}

// Rounding of a hand that stands still is no turn.
TEST(RigidMotion, WhatNoLongerTurnsKeepsItsBits) {
  const Quat from(Eigen::AngleAxisd(0.7, Vec3(1, 2, 3).normalized()));
  Quat to = from;
  to.y() = std::nextafter(from.y(), 1.0);
  EXPECT_EQ(turned_towards(from, to, 0.05).coeffs(), from.coeffs());
  to = Quat(Eigen::AngleAxisd(1e-9, Vec3::UnitX())) * from;
  EXPECT_EQ(turned_towards(from, to, 0.05).coeffs(), to.coeffs());
}

TEST(RigidMotion, VelocityAndTravelOfAPoint) {
  BoneMotion m;
  m.X_WB.p = Vec3(1, 0, 0);
  m.v_W = Vec3(0, 0, 1);
  m.w_W = Vec3(0, 0, 2);
  EXPECT_LT((velocity_at(m, Vec3(2, 0, 0)) - Vec3(0, 2, 1)).norm(), 1e-15);

  Random random(8);
  for (int i = 0; i < 200; ++i) {
    const Pose before{0.1 * random.direction(), random.rotation()};
    const double angle = random.uniform(0, 0.2);
    const Vec3 axis = random.direction();
    const Vec3 shift = 0.002 * random.direction();
    const Pose after = Pose{shift, Quat(Eigen::AngleAxisd(angle, axis))} * before;
    const Vec3 p = 0.1 * random.direction();
    const double bound = travel(before, after, p, 0.01);
    for (int k = 0; k < 20; ++k) {  // every point within reach moves by no more
      const Vec3 x = p + 0.01 * random.direction();
      ASSERT_LE((before * (after.inverse() * x) - x).norm(), bound + 1e-12);
    }
  }
}

}  // namespace
}  // namespace osteon
