#include "osteon/tissue/held_joint.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <numbers>

namespace osteon::held_joints {
namespace {

constexpr double kRad = std::numbers::pi / 180;

JointFibre fibre(const Vec3& from, const Vec3& to, double slack_m, double stiffness_n) {
  JointFibre f;
  f.from_F = from;
  f.to_T = to;
  f.slack_m = slack_m;
  f.stiffness_n = stiffness_n;
  return f;
}

/// Weak springs that keep turns definite and bear no load of these tests.
JointSurround turns_only() { return {0, 0, 10, {}}; }

/// A slab whose upper face is y, z in +-0.1 m at the height x = 0, solid below.
std::shared_ptr<const MeshDistance> slab() {
  TriMesh m;
  for (int i = 0; i < 8; ++i)
    m.vertices.emplace_back(i & 1 ? 0 : -0.05, i & 2 ? 0.1 : -0.1, i & 4 ? 0.1 : -0.1);
  m.triangles = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                 {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
  return std::make_shared<MeshDistance>(m);
}

TEST(HeldJoint, ABoneThatNothingHoldsIsAnError) {
  const auto none = settle({}, {}, {});
  ASSERT_FALSE(none);
  EXPECT_NE(none.error().message().find("nothing holds the tibia"), std::string::npos);
  HeldJoint torn;
  torn.fibres = {fibre({0, 0, 0}, {0.03, 0, 0}, 0.03, 0)};
  EXPECT_FALSE(settle(torn, {}, {}));
}

TEST(HeldJoint, NumbersThatAreNotFiniteAreErrors) {
  HeldJoint joint;
  joint.fibres = {fibre({0, 0, 0}, {0.03, 0, 0}, 0.03, 1000)};
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(settle(joint, {Vec3(nan, 0, 0), 0, 0}, {}));
  EXPECT_FALSE(settle(joint, {Vec3::Zero(), nan, 0}, {}));
  HeldJoint broken = joint;
  broken.fibres[0].slack_m = 0;
  EXPECT_FALSE(settle(broken, {}, {}));
  broken = joint;
  broken.fibres[0].to_T.x() = nan;
  EXPECT_FALSE(settle(broken, {}, {}));
  JointPose start;
  start.varus_rad = nan;
  EXPECT_FALSE(settle(joint, {}, start));
}

TEST(HeldJoint, OneFibreStretchesAsItsLawSays) {
  // Straight pulls: k e^2 / (4 toe) below twice the toe strain, k (e - toe) above.
  HeldJoint joint;
  joint.fibres = {fibre({0, 0, 0}, {0, 0, 0}, 0.03, 4000)};
  joint.surround = turns_only();
  JointPose start;
  start.middle_F = {0.031, 0, 0};
  for (const double force : {10.0, 60.0, 500.0}) {
    const auto at = settle(joint, {Vec3(force, 0, 0), 0, 0}, start);
    ASSERT_TRUE(at);
    ASSERT_TRUE(at->converged);
    const double toe = 0.03;
    const double strain =
        force < 4000 * toe ? std::sqrt(4 * toe * force / 4000) : force / 4000 + toe;
    EXPECT_NEAR(at->pose.middle_F.x(), 0.03 * (1 + strain), 3e-7) << force;
    EXPECT_NEAR(at->fibres[0].tension_n, force, 0.02);
    EXPECT_NEAR(at->fibres[0].strain, strain, 1e-5);
  }
}

TEST(HeldJoint, ASymmetricPairSharesThePullAndStaysInTheMiddle) {
  HeldJoint joint;
  joint.fibres = {fibre({0, 0.02, 0}, {0, 0.005, 0}, 0.03, 3000),
                  fibre({0, -0.02, 0}, {0, -0.005, 0}, 0.03, 3000)};
  joint.surround = turns_only();
  JointPose start;
  start.middle_F = {0.03, 0.001, 0};
  const auto at = settle(joint, {Vec3(80, 0, 0), 0, 0}, start);
  ASSERT_TRUE(at && at->converged);
  EXPECT_NEAR(at->pose.middle_F.y(), 0, 1e-6);
  EXPECT_NEAR(at->fibres[0].tension_n, at->fibres[1].tension_n, 0.05);
  // Along the load: 2 T cos(angle) = 80.
  const double cos_angle = at->pose.middle_F.x() / at->fibres[0].length_m;
  EXPECT_NEAR(2 * at->fibres[0].tension_n * cos_angle, 80, 0.02);
}

TEST(HeldJoint, CartilageOnAPlaneCarriesTheLoadAsSpringsSideBySide) {
  HeldJoint joint;
  joint.fibres = {fibre({-1, 0, 0}, {0, 0, 0}, 2, 1000)};  // slack
  joint.surface_F = slab();
  joint.solids_F = {joint.surface_F};
  for (const double y : {-0.02, 0.02})
    for (const double z : {-0.02, 0.02}) joint.beds.push_back({{0.01, y, z}, 0.002, 50000});
  joint.surround = {100, 100, 0, {}};
  JointPose start;
  start.middle_F = {-0.008, 0, 0};
  joint.surround.about = start;
  const auto at = settle(joint, {Vec3(-60, 0, 0), 0, 0}, start);
  ASSERT_TRUE(at && at->converged);
  // Four springs of 50 N/mm press by 60 N less what the surroundings take.
  const double overlap = 0.002 - (at->pose.middle_F.x() + 0.01);
  EXPECT_NEAR(4 * 50000 * overlap, at->contact_n, 1e-6);
  EXPECT_NEAR(at->contact_n - 100 * (at->pose.middle_F.x() + 0.008), 60, 0.02);
  // Half a millimetre more to one side tips the load: moments balance.
  const auto tipped = settle(joint, {Vec3(-60, 0, 0), 0.3, 0}, start);
  ASSERT_TRUE(tipped && tipped->converged);
  // Four springs at 20 mm: 4 k d^2 of stiffness against turning.
  EXPECT_NEAR(tipped->pose.varus_rad, 0.3 / (4 * 50000 * 0.02 * 0.02), 3e-5);
}

// In a groove of 45 degrees a bed rests on both walls: across, the force jumps from one side to the
// other and balances nowhere. Along it half of the walls' push carries: k o / sqrt(2) = F.
TEST(HeldJoint, ItRestsInAFoldWhereTheForceJumps) {
  TriMesh groove;
  for (const double y : {0.0, 0.1, -0.1})
    for (const double z : {-0.1, 0.1}) groove.vertices.emplace_back(std::abs(y), y, z);
  groove.triangles = {{0, 2, 1}, {1, 2, 3}, {0, 1, 4}, {1, 5, 4}};
  HeldJoint joint;
  joint.fibres = {fibre({-1, 0, 0}, {0, 0, 0}, 2, 1000)};  // slack
  joint.surface_F = std::make_shared<MeshDistance>(groove);
  joint.beds = {{Vec3::Zero(), 0.002, 50000}};
  joint.surround = turns_only();
  joint.surround.across_n_per_m = 1;
  for (const double y : {0.0007, -0.0004}) {
    JointPose start;
    start.middle_F = {0.0025, y, 0};
    const auto at = settle(joint, {Vec3(-60, 0, 0), 0, 0}, start);
    ASSERT_TRUE(at);
    EXPECT_TRUE(at->converged) << at->unbalanced_n << " N after " << at->rounds;
    EXPECT_NEAR(at->pose.middle_F.y(), 0, 2e-6);
    const double overlap = 60 * std::sqrt(2.0) / 50000;
    EXPECT_NEAR(at->pose.middle_F.x(), (0.002 - overlap) * std::sqrt(2.0), 4e-6);
    EXPECT_NEAR(at->contact_n, 60 * std::sqrt(2.0), 0.2);
  }
}

TEST(HeldJoint, PosesComeBackFromTheirTurns) {
  HeldJoint joint;
  joint.middle_T = {0.01, 0.002, -0.003};
  const JointPose pose{70 * kRad, 4 * kRad, 12 * kRad, {0.02, 0.001, 0.005}};
  const JointPose back = joint_pose(joint, pose_of(joint, pose));
  EXPECT_NEAR(back.flexion_rad, pose.flexion_rad, 1e-12);
  EXPECT_NEAR(back.varus_rad, pose.varus_rad, 1e-12);
  EXPECT_NEAR(back.internal_rad, pose.internal_rad, 1e-12);
  EXPECT_LT((back.middle_F - pose.middle_F).norm(), 1e-12);
  // Bent by a right angle, the foot points backwards and the shin's front along the thigh.
  EXPECT_LT((along_F(90 * kRad) - Vec3(0, 0, -1)).norm(), 1e-12);
  EXPECT_LT((front_F(90 * kRad) - Vec3(1, 0, 0)).norm(), 1e-12);
}

TEST(HeldJoint, TheRestingPlaceIsAMinimumThatOtherStartsFindToo) {
  HeldJoint joint;
  joint.fibres = {fibre({0, 0.01, 0}, {0.0, 0.02, 0.01}, 0.03, 3000),
                  fibre({0, -0.02, 0.01}, {0, -0.01, -0.01}, 0.032, 2000),
                  fibre({0, 0, -0.02}, {0, 0.005, 0.01}, 0.04, 4000)};
  joint.surround = {500, 500, 1, {}};
  joint.surround.about.middle_F = {0.03, 0, 0};
  const JointLoad load{Vec3(30, 10, 80), 1, 2};
  JointPose start = joint.surround.about;
  start.flexion_rad = 30 * kRad;
  joint.surround.about.flexion_rad = start.flexion_rad;
  const auto one = settle(joint, load, start);
  ASSERT_TRUE(one && one->converged);
  start.middle_F += Vec3(0.002, -0.003, 0.004);
  start.varus_rad = 0.05;
  const auto other = settle(joint, load, start);
  ASSERT_TRUE(other && other->converged);
  EXPECT_LT((one->pose.middle_F - other->pose.middle_F).norm(), 1e-5);
  EXPECT_NEAR(one->energy_j, other->energy_j, 1e-7);
}

TEST(HeldJoint, TheSameTwiceIsTheSameBitByBit) {
  HeldJoint joint;
  joint.fibres = {fibre({0, 0.01, 0}, {0.0, 0.02, 0.01}, 0.03, 3000)};
  joint.surround = {500, 500, 1, {}};
  const JointLoad load{Vec3(30, 10, 80), 1, 2};
  const auto one = settle(joint, load, {}), two = settle(joint, load, {});
  ASSERT_TRUE(one && two);
  EXPECT_EQ(0, std::memcmp(&one->pose.middle_F, &two->pose.middle_F, sizeof(Vec3)));
}

}  // namespace
}  // namespace osteon::held_joints
