#include "case/build_joints.h"

#include <gtest/gtest.h>

#include <cmath>

#include "osteon/scene/state.h"

namespace osteon {
namespace {

std::vector<Bone> three_bones() {
  std::vector<Bone> bones(3);
  bones[0].name = "femur";
  bones[1].name = "tibia";
  bones[2].name = "patella";
  bones[0].X_WB.p = {0.1, 0.2, 0.3};
  bones[0].X_WB.q = Quat(Eigen::AngleAxisd(0.5, Vec3::UnitZ()));
  return bones;
}

/// The tibia turns about y by its degrees, 0 to 90.
JointDef hinge() {
  JointDef joint{"flexion", "femur", 30, {}};
  joint.bones = {{"tibia", {0, 10, {}}}};
  for (int k = 0; k <= 9; ++k) {
    const double a = k * 10 * 3.14159265358979323846 / 180;
    joint.bones[0].X_FB.poses.push_back(
        {Vec3(0.01, 0, 0), Quat(Eigen::AngleAxisd(a, Vec3::UnitY()))});
  }
  return joint;
}

/// What is said when this joint is not taken.
std::string refusal(const JointDef& joint) {
  const auto built = build_joints({joint}, three_bones());
  return built ? "" : built.error().message();
}

TEST(BuildJoints, FindsItsBonesAndRange) {
  const auto joints = build_joints({hinge()}, three_bones());
  ASSERT_TRUE(joints) << joints.error().message();
  EXPECT_EQ(joints->at(0).fixed, BoneId{0});
  EXPECT_EQ(joints->at(0).bones.at(0).bone, BoneId{1});
  EXPECT_EQ(joints->at(0).min_deg(), 0);
  EXPECT_EQ(joints->at(0).max_deg(), 90);
}

TEST(BuildJoints, RefusesWhatIsNotSound) {
  JointDef bad = hinge();
  bad.fixed = "hip";
  EXPECT_NE(refusal(bad).find("no bone 'hip'"), std::string::npos);
  bad = hinge();
  bad.bones.clear();
  EXPECT_NE(refusal(bad).find("moves no bone"), std::string::npos);
  bad = hinge();
  bad.bones[0].bone = "femur";
  EXPECT_NE(refusal(bad).find("twice"), std::string::npos);
  bad = hinge();
  bad.bones[0].X_FB.poses.clear();
  EXPECT_NE(refusal(bad).find("poses"), std::string::npos);
  bad = hinge();
  bad.bones[0].X_FB.poses[3].p.x() = std::nan("");
  EXPECT_NE(refusal(bad).find("poses"), std::string::npos);
  bad = hinge();
  bad.bones[0].X_FB.step = 0;
  EXPECT_NE(refusal(bad).find("poses"), std::string::npos);
  bad = hinge();
  bad.at_deg = 91;
  EXPECT_NE(refusal(bad).find("beyond its range"), std::string::npos);
  bad = hinge();
  bad.bones.push_back({"patella", {0, 5, bad.bones[0].X_FB.poses}});
  EXPECT_NE(refusal(bad).find("different ranges"), std::string::npos);
  EXPECT_FALSE(build_joints({hinge(), hinge()}, three_bones()));
}

TEST(BuildJoints, ABentSnapshotMovesTheJointsBonesInTheFrameOfTheFixedOne) {
  Case bones;
  bones.bones = three_bones();
  bones.joints = build_joints({hinge()}, bones.bones).value();
  const BoneSnapshot bent = bent_snapshot(bones, bones.joints[0], 60);
  EXPECT_EQ(bent.bones[0].X_WB.p, bones.bones[0].X_WB.p);
  EXPECT_EQ(bent.bones[2].X_WB.p, bones.bones[2].X_WB.p);
  const Pose X_FB = bones.bones[0].X_WB.inverse() * bent.bones[1].X_WB;
  EXPECT_LT((X_FB.p - Vec3(0.01, 0, 0)).norm(), 1e-12);
  EXPECT_NEAR(X_FB.q.angularDistance(Quat::Identity()), 60 * 3.14159265358979323846 / 180, 1e-9);
}

}  // namespace
}  // namespace osteon
