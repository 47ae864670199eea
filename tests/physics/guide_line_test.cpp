#include "osteon/physics/guide_line.h"

#include <gtest/gtest.h>

namespace osteon {
namespace {

constexpr double kWithin = 1e-12;

CarvingTool pin() {
  CarvingTool tool;
  tool.cutter.size_m = 0.0024;
  return tool;
}
CarvingTool hollow_drill() {
  CarvingTool tool;
  tool.cutter.size_m = 0.008;
  tool.pilot_m = 0.0025;
  return tool;
}
GuideRod rod(GuideRod::Kind kind, const Pose& X_BR) {
  GuideRod out;
  out.kind = kind;
  out.bone = 1;
  out.X_BR = X_BR;
  out.radius_m = 0.0012;
  out.length_m = 0.060;
  out.in_bone_m = kind == GuideRod::Kind::kPin ? 0.030 : 0;
  return out;
}
std::array<BoneMotion, 2> two_bones() {
  std::array<BoneMotion, 2> bones{};
  bones[1].X_WB = {Vec3(0.1, 0, 0), Quat(Eigen::AngleAxisd(0.3, Vec3::UnitX()))};
  return bones;
}

TEST(GuideLine, APinLeadsWhatIsHollowAndASleeveWhatIsThin) {
  EXPECT_FALSE(rod_leads({}, pin())) << "there is no rod";
  EXPECT_TRUE(rod_leads(rod(GuideRod::Kind::kPin, {}), hollow_drill()));
  EXPECT_FALSE(rod_leads(rod(GuideRod::Kind::kPin, {}), pin()));
  EXPECT_TRUE(rod_leads(rod(GuideRod::Kind::kSleeve, {}), pin()));
  EXPECT_FALSE(rod_leads(rod(GuideRod::Kind::kSleeve, {}), hollow_drill()));
}

TEST(GuideLine, WhatNothingLeadsIsHeldAsItIs) {
  const auto bones = two_bones();
  EXPECT_FALSE(held_on_rod({}, bones, pin(), {}));
  GuideRods rods{};
  rods[2] = rod(GuideRod::Kind::kPin, {});
  EXPECT_FALSE(held_on_rod(rods, bones, pin(), {}));
  rods[2].bone = 7;
  EXPECT_FALSE(held_on_rod(rods, bones, hollow_drill(), {})) << "of a bone that is not there";
}

TEST(GuideLine, TheAxisLiesInTheRodsAndTheTipOutsideOfItsBone) {
  const auto bones = two_bones();
  GuideRods rods{};
  rods[0] = rod(GuideRod::Kind::kSleeve,
                {Vec3(0.01, 0.02, 0), Quat(Eigen::AngleAxisd(0.8, Vec3(1, 2, 0).normalized()))});
  const Pose X_WR = bones[1].X_WB * rods[0].X_BR;
  const Vec3 out = X_WR.q * Vec3::UnitZ();
  for (const double along_m : {-0.02, 0.02, 0.2}) {
    // Beside the line, turned away from it and about it.
    const Pose like{X_WR * Vec3(0.003, -0.002, along_m),
                    X_WR.q * Quat(Eigen::AngleAxisd(0.2, Vec3::UnitX())) *
                        Quat(Eigen::AngleAxisd(1.5, Vec3::UnitZ()))};
    const auto held = held_on_rod(rods, bones, pin(), like);
    ASSERT_TRUE(held);
    EXPECT_NEAR((held->q * Vec3::UnitZ()).dot(out), 1, kWithin);
    EXPECT_NEAR(held->q.norm(), 1, kWithin);
    const Vec3 p_R = X_WR.inverse() * held->p;
    EXPECT_NEAR(p_R.head<2>().norm(), 0, kWithin);
    EXPECT_NEAR(p_R.z(), std::clamp(along_m, 0.004, 0.060), kWithin);
    EXPECT_LT(held->q.angularDistance(like.q), 0.2 + kWithin) << "turned no more than it has to be";
  }
  rods[0].kind = GuideRod::Kind::kPin;
  rods[0].in_bone_m = 0.030;
  const auto over = held_on_rod(rods, bones, hollow_drill(), X_WR);
  ASSERT_TRUE(over);
  EXPECT_NEAR((X_WR.inverse() * over->p).z(), 0.031, kWithin) << "over the bone that the pin is in";
}

TEST(GuideLine, OfTwoRodsTheNearerOneLeads) {
  const auto bones = two_bones();
  GuideRods rods{};
  rods[0] = rod(GuideRod::Kind::kSleeve, {Vec3(0.05, 0, 0), Quat::Identity()});
  rods[3] = rod(GuideRod::Kind::kSleeve, {Vec3(0.01, 0, 0), Quat::Identity()});
  const auto held =
      held_on_rod(rods, bones, pin(), bones[1].X_WB * Pose{Vec3(0.014, 0, 0.03), Quat::Identity()});
  ASSERT_TRUE(held);
  EXPECT_NEAR((bones[1].X_WB.inverse() * held->p - Vec3(0.01, 0, 0.03)).norm(), 0, kWithin);
}

}  // namespace
}  // namespace osteon
