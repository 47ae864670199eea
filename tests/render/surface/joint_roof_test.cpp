#include "osteon/render/joint_roof.h"

#include <gtest/gtest.h>

#include <limits>

#include "../scenes.h"

namespace osteon {
namespace {

const Vec3 kUpwards = Vec3::UnitZ();

Case ball_above() {
  Case made;
  made.bones.push_back(make_bone("ball", sphere_mesh(0.004), Vec3(0, 0, 0.020)));
  return made;
}

SoftPart plate(const std::string& kind, double z) {
  SoftPart soft;
  soft.name = kind;
  soft.kind = kind;
  soft.mesh_W.vertices = {{-0.01, -0.01, z}, {0.01, -0.01, z}, {0, 0.02, z}};
  soft.mesh_W.triangles = {{0, 2, 1}};  // it faces down
  soft.bones = {BoneId{0}};
  return soft;
}

TEST(JointRoof, NothingClosesAnEmptyCaseOrAPlaceThatIsNone) {
  EXPECT_FALSE(JointRoof(Case{}).distance({}, Vec3::Zero(), kUpwards, 1));
  const Case ball = ball_above();
  const Vec3 nowhere(std::numeric_limits<double>::quiet_NaN(), 0, 0);
  EXPECT_FALSE(JointRoof(ball).distance(rest_snapshot(ball), nowhere, kUpwards, 1));
}

TEST(JointRoof, ABoneClosesWhereItStands) {
  const Case ball = ball_above();
  const JointRoof roof(ball);
  BoneSnapshot bones = rest_snapshot(ball);
  ASSERT_TRUE(roof.distance(bones, Vec3::Zero(), kUpwards, 0.06));
  EXPECT_NEAR(*roof.distance(bones, Vec3::Zero(), kUpwards, 0.06), 0.016, 1e-4);
  EXPECT_FALSE(roof.distance(bones, Vec3::Zero(), kUpwards, 0.015)) << "beyond the length";
  EXPECT_FALSE(roof.distance(bones, Vec3(0.01, 0, 0), kUpwards, 0.06)) << "beside it";
  EXPECT_FALSE(roof.distance(bones, Vec3(0, 0, 0.021), kUpwards, 0.06)) << "within it";
  bones.bones[0].X_WB.p.z() += 0.005;
  EXPECT_NEAR(*roof.distance(bones, Vec3::Zero(), kUpwards, 0.06), 0.021, 1e-4);
}

TEST(JointRoof, SoftPartsCloseAndMoveWithTheirBonesButNotSkinAndFat) {
  Case the_case = ball_above();
  the_case.softs = {plate("cartilage", 0.010), plate("fat", 0.005), plate("skin", 0.004)};
  const JointRoof roof(the_case);
  BoneSnapshot bones = rest_snapshot(the_case);
  EXPECT_NEAR(*roof.distance(bones, Vec3::Zero(), kUpwards, 0.06), 0.010, 1e-9);
  bones.bones[0].X_WB.p.z() += 0.002;
  EXPECT_NEAR(*roof.distance(bones, Vec3::Zero(), kUpwards, 0.06), 0.012, 1e-9);
}

TEST(JointRoof, TheWallClosesOfTheOneThatWasGivenIt) {
  const JointRoof bare(Case{});
  const JointRoof walled = bare.with_wall(plate("wall", 0.007).mesh_W);
  EXPECT_NEAR(*walled.distance({}, Vec3::Zero(), kUpwards, 0.06), 0.007, 1e-9);
  EXPECT_FALSE(bare.distance({}, Vec3::Zero(), kUpwards, 0.06));
}

}  // namespace
}  // namespace osteon
