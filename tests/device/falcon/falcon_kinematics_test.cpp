#include "falcon/falcon_kinematics.h"

#include <gtest/gtest.h>

#include <cmath>

#include "osteon/base/random.h"

namespace osteon {
namespace {

// A position in the ball that the workspace is.
Vec3 somewhere(Random& random) {
  const Vec3 direction = random.direction();
  const double share = std::cbrt(random.uniform());
  return falcon::kCentre_F + 0.040 * share * direction;
}

TEST(FalconKinematics, CountsOnTheAxisAreThoseOfTheMachine) {
  const std::pair<double, double> known[] = {{.075, -1463}, {.125, -200}, {.175, 1056}};
  for (const auto& [z, counts] : known) {
    const auto angles = falcon::joint_angles(Vec3(0, 0, z));
    ASSERT_TRUE(angles);
    for (int i = 0; i < 3; ++i) EXPECT_NEAR(falcon::counts_of(*angles)[i], counts, 0.6) << z;
  }
}

TEST(FalconKinematics, TheLegsClose) {
  // With the angle found, the arm's end must lie as far from the grip as the parallelogram is long:
  // rebuilt here from the lengths alone.
  Random random(1);
  for (int n = 0; n < 1000; ++n) {
    const Vec3 p = somewhere(random);
    const auto angles = falcon::joint_angles(p);
    ASSERT_TRUE(angles) << p.transpose();
    for (int i = 0; i < 3; ++i) {
      const double phi = (90 - 120 * i + 15) * M_PI / 180;
      const Vec3 u(std::cos(phi), std::sin(phi), 0);
      const Vec3 v(-std::sin(phi), std::cos(phi), 0);
      const Vec3 w(0, 0, 1);
      const double t = (*angles)[i];
      const Vec3 arm_end = 0.0400 * u - 0.02309 * v + 0.060 * (std::cos(t) * u + std::sin(t) * w);
      const Vec3 joint = p + 0.01443 * u - 0.025 * v;
      const Vec3 bridge = joint - arm_end;
      // In the plane (u, w) two short joints of 11.25 mm lie in line with the sides of 102.5 mm.
      const Vec3 in_plane = bridge - bridge.dot(v) * v;
      const Vec3 side = bridge - in_plane.normalized() * (2 * 0.01125);
      ASSERT_NEAR(side.norm(), 0.1025, 1e-12);
    }
  }
}

TEST(FalconKinematics, ForwardUndoesInverse) {
  Random random(2);
  double worst = 0;
  for (int n = 0; n < 10000; ++n) {
    const Vec3 p = somewhere(random);
    const auto angles = falcon::joint_angles(p);
    ASSERT_TRUE(angles);
    // From the middle, and from where the last reading may have been.
    const Vec3 near_by = p + 0.002 * random.direction();
    for (const Vec3& guess : {falcon::kCentre_F, near_by}) {
      const auto back = falcon::grip_position(*angles, guess);
      ASSERT_TRUE(back) << p.transpose();
      worst = std::max(worst, (*back - p).norm());
    }
  }
  EXPECT_LT(worst, 1e-9);
}

TEST(FalconKinematics, JacobianIsTheSlope) {
  Random random(3);
  constexpr double kStep = 1e-6;
  for (int n = 0; n < 2000; ++n) {
    const Vec3 p = somewhere(random);
    const auto J = falcon::angle_jacobian(p);
    ASSERT_TRUE(J);
    for (int axis = 0; axis < 3; ++axis) {
      const Vec3 h = kStep * Vec3::Unit(axis);
      const Vec3 slope =
          (*falcon::joint_angles(p + h) - *falcon::joint_angles(p - h)) / (2 * kStep);
      ASSERT_LT((J->col(axis) - slope).norm(), 1e-6 * J->norm());
    }
  }
}

TEST(FalconKinematics, MotorsDoTheWorkThatTheGripDoes) {
  Random random(4);
  for (int n = 0; n < 2000; ++n) {
    const Vec3 p = somewhere(random);
    const Vec3 direction = random.direction();
    const Vec3 force = random.uniform(0.5, 3.0) * direction;
    const Vec3 dp = 1e-6 * random.direction();
    const auto counts = falcon::motor_counts(force, p);
    const Vec3 torque = Vec3(counts[0], counts[1], counts[2]) / falcon::kCountsPerNm;
    const Vec3 dq = *falcon::joint_angles(p + dp) - *falcon::joint_angles(p);
    // Half a count on each motor is all that may be missing.
    const double bound = 0.5 / std::abs(falcon::kCountsPerNm) * dq.cwiseAbs().sum();
    ASSERT_NEAR(torque.dot(dq), force.dot(dp), bound + 1e-9 * force.norm() * dp.norm() + 1e-11);
  }
}

TEST(FalconKinematics, TooMuchForceKeepsItsDirection) {
  Random random(5);
  int limited = 0;
  for (int n = 0; n < 2000; ++n) {
    const Vec3 p = somewhere(random);
    const Vec3 direction = random.direction();
    const auto counts = falcon::motor_counts(50 * direction, p);
    for (const int c : counts) ASSERT_LE(std::abs(c), falcon::kMotorLimit);
    const Vec3 torque = Vec3(counts[0], counts[1], counts[2]) / falcon::kCountsPerNm;
    const Vec3 force = falcon::angle_jacobian(p)->transpose() * torque;
    ASSERT_GT(force.normalized().dot(direction), 0.99999);
    limited += force.norm() < 49 ? 1 : 0;
  }
  EXPECT_GT(limited, 1900);
}

TEST(FalconKinematics, ASmallForceOnTheAxisPushesAllMotorsAlike) {
  const auto counts = falcon::motor_counts(Vec3(0, 0, 3), falcon::kCentre_F);
  EXPECT_NE(counts[0], 0);
  EXPECT_NEAR(counts[0], counts[1], 1);
  EXPECT_NEAR(counts[1], counts[2], 1);
}

TEST(FalconKinematics, WhereTheLegsDoNotReachThereIsNothing) {
  for (const Vec3& p : {Vec3(0, 0, 0.5), Vec3(0.3, 0, 0.125), Vec3(0, -0.2, 0.1),
                        Vec3(std::nan(""), 0, 0.1), Vec3(0, 0, INFINITY)}) {
    EXPECT_FALSE(falcon::joint_angles(p));
    EXPECT_FALSE(falcon::angle_jacobian(p));
    EXPECT_EQ(falcon::motor_counts(Vec3(1, 1, 1), p), (std::array<int, 3>{0, 0, 0}));
  }
  EXPECT_EQ(falcon::motor_counts(Vec3(NAN, 0, 0), falcon::kCentre_F),
            (std::array<int, 3>{0, 0, 0}));
}

TEST(FalconKinematics, AnglesOfNoPositionAreRefused) {
  Random random(6);
  int found = 0;
  for (int n = 0; n < 5000; ++n) {
    std::array<int, 3> counts{};
    for (int& c : counts) c = static_cast<int>(random.uniform(-32768, 32767));
    const Vec3 angles = falcon::angles_of(counts);
    const auto p = falcon::grip_position(angles, falcon::kCentre_F);
    if (!p) continue;
    ++found;
    ASSERT_LT((*falcon::joint_angles(*p) - angles).cwiseAbs().maxCoeff(), 1e-9);
  }
  EXPECT_LT(found, 50);
  EXPECT_FALSE(falcon::grip_position(Vec3(NAN, 0, 0), falcon::kCentre_F));
}

TEST(FalconKinematics, ResolutionIsWhatTheDriverReckonsWith) {
  // The positions that one count apart stand in the middle of the workspace.
  const auto angles = falcon::joint_angles(falcon::kCentre_F);
  const double count_rad = (falcon::angles_of({1, 0, 0}) - falcon::angles_of({0, 0, 0})).norm();
  double longest = 0;
  for (int i = 0; i < 3; ++i) {
    const auto p = falcon::grip_position(*angles + count_rad * Vec3::Unit(i), falcon::kCentre_F);
    ASSERT_TRUE(p);
    longest = std::max(longest, (*p - falcon::kCentre_F).norm());
  }
  EXPECT_NEAR(longest, falcon::kResolution_m, 0.5 * falcon::kResolution_m);
}

}  // namespace
}  // namespace osteon
