#include "osteon/scene/marks_now.h"

#include <gtest/gtest.h>

#include "../placing_case.h"

namespace osteon {
namespace {

// A knee that bends, with a mark on each bone and two on none.
Case marked_knee(std::optional<double> begin_deg = {}) {
  CaseDef def = testing::placing_def();
  testing::let_bend(def, begin_deg);
  def.landmarks.clear();
  def.landmarks.push_back({"free", Vec3(0.1, 0.2, 0.3), Vec3::Zero()});
  def.landmarks.push_back({"on_femur", Vec3(0.1, 0.2, 0.3), Vec3::Zero(), "femur"});
  def.landmarks.push_back({"on_tibia", Vec3(0.1, 0.2, 0.3), Vec3::UnitX(), "tibia"});
  def.landmarks.push_back({"on_nothing", Vec3(0.1, 0.2, 0.3), Vec3::Zero(), "ulna"});
  auto built = build_case(std::move(def));
  EXPECT_TRUE(built) << (built ? "" : built.error().message());
  return std::move(*built);
}

TEST(MarksNow, AtRestEachIsWhereTheCaseHasItToTheBit) {
  const Case knee = marked_knee();
  const BoneSnapshot rest = rest_snapshot(knee);
  for (std::uint32_t i = 0; i < 4; ++i)
    EXPECT_EQ(place_now(knee, i, rest), knee.landmarks[i].p_W) << i;
  EXPECT_EQ(begun_bones(knee).bones[1].X_WB.p, knee.bones[1].X_WB.p);
}

TEST(MarksNow, OneOfABoneThatAJointMovesGoesWithIt) {
  const Case knee = marked_knee();
  BoneSnapshot bones = rest_snapshot(knee);
  const Pose moved{Vec3(0.01, 0, 0), Quat(Eigen::AngleAxisd(0.3, Vec3::UnitZ()))};
  for (std::size_t b = 0; b < 2; ++b) bones.bones[b].X_WB = moved * knee.bones[b].X_WB;
  for (const std::uint32_t stays : {0u, 1u, 3u})
    EXPECT_EQ(place_now(knee, stays, bones), knee.landmarks[stays].p_W) << stays;
  EXPECT_LT((place_now(knee, 2, bones) - moved * knee.landmarks[2].p_W).norm(), 1e-12);
  EXPECT_EQ(moved_from_rest(knee, 99, bones).p, Vec3(0, 0, 0));
}

TEST(MarksNow, ACaseThatBeginsOtherwiseBentHasBonesAndMarksThere) {
  const Case knee = marked_knee(30);
  ASSERT_EQ(knee.joints[0].begin_deg, 30);
  const Pose turned = pose_at(knee.joints[0].bones[0].X_FB, 30);
  const Case begun = as_it_begins(knee);
  EXPECT_LT((begun.bones[1].X_WB.p - (knee.bones[0].X_WB * turned).p).norm(), 1e-12);
  EXPECT_EQ(begun.bones[0].X_WB.p, knee.bones[0].X_WB.p);
  EXPECT_EQ(begun.landmarks[0].p_W, knee.landmarks[0].p_W);
  EXPECT_GT((begun.landmarks[2].p_W - knee.landmarks[2].p_W).norm(), 0.01);
  const Pose X_moved = begun.bones[1].X_WB * knee.bones[1].X_WB.inverse();
  EXPECT_LT((begun.landmarks[2].inwards_W - X_moved.rotate(Vec3::UnitX())).norm(), 1e-12);
  EXPECT_NE(knee.hash, marked_knee().hash);
  EXPECT_NE(knee.hash, marked_knee(31).hash);
}

TEST(MarksNow, ABeginningBeyondTheJointsRangeIsRefused) {
  CaseDef def = testing::placing_def();
  JointDef knee;
  knee.name = "flexion";
  knee.fixed = "femur";
  knee.begin_deg = 61;
  PoseTrack track{0, 30, {Pose{}, Pose{}, Pose{}}};
  knee.bones.push_back({"tibia", track});
  def.joints.push_back(knee);
  const auto built = build_case(std::move(def));
  ASSERT_FALSE(built);
  EXPECT_NE(built.error().message().find("flexion"), std::string::npos);
}

TEST(MarksNow, AMarkLiesOnTheMeniscusWhoseSurfaceIsWithinAMillimetre) {
  Case knee = marked_knee();
  for (const char* kind : {"fat", "meniscus"}) {
    SoftPart soft;
    soft.name = soft.kind = kind;
    soft.mesh_W.vertices = {{0, 0, 0}, {0.01, 0, 0}, {0, 0.01, 0}, {0, 0, 0.01}};
    soft.mesh_W.triangles = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};
    knee.softs.push_back(soft);
  }
  const std::uint32_t meniscus = static_cast<std::uint32_t>(knee.softs.size()) - 1;
  knee.landmarks[0].p_W = {0.002, 0.002, -0.0009};
  knee.landmarks[1].p_W = {0.002, 0.002, -0.0011};
  EXPECT_EQ(meniscus_under(knee, 0), meniscus);
  EXPECT_FALSE(meniscus_under(knee, 1));
  EXPECT_FALSE(meniscus_under(knee, 99));
  knee.softs.back().mesh_W = {};
  EXPECT_FALSE(meniscus_under(knee, 0)) << "the case does not show it";
}

}  // namespace
}  // namespace osteon
