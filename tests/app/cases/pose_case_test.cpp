#include "cases/pose_case.h"

#include <gtest/gtest.h>

namespace osteon {
namespace {

CaseDef two_bones_joined() {
  CaseDef def;
  def.name = "test";
  def.bones.resize(2);
  def.bones[0].name = "femur";
  def.bones[1].name = "tibia";
  JointDef joint{"flexion", "femur", 0, {}};
  joint.bones = {{"tibia", {0, 10, std::vector<Pose>(10)}}};
  def.joints = {joint};
  return def;
}

std::string refusal(CaseDef def, const std::string& joint, double degrees) {
  const auto bent = bend_case(std::move(def), joint, degrees, false);
  return bent ? "" : bent.error().message();
}

TEST(PoseCase, SaysWhyItCannotBend) {
  EXPECT_NE(refusal({}, "flexion", 10).find("no joint 'flexion'"), std::string::npos);
  EXPECT_NE(refusal(two_bones_joined(), "hinge", 10).find("It has flexion"), std::string::npos);
  EXPECT_NE(refusal(two_bones_joined(), "flexion", 91).find("0 to 90"), std::string::npos);
  EXPECT_NE(refusal(two_bones_joined(), "flexion", -1).find("0 to 90"), std::string::npos);
  EXPECT_NE(refusal(two_bones_joined(), "flexion", 10).find("how it was generated"),
            std::string::npos);
}

/// A case whose recipe grows other bones is left alone: the user has changed them.
TEST(PoseCase, BonesThatWereChangedAreNotReplaced) {
  CaseDef def = two_bones_joined();
  def.recipe = CaseRecipe{"knee", {}, {}, {}, {}};
  EXPECT_NE(refusal(def, "flexion", 10).find("bone 'femur' was changed after it was generated"),
            std::string::npos);
}

TEST(PoseCase, ARecipeIsTheOrderItCameFrom) {
  const PatientOrder order{"knee", 7, {{"size_percent", 104.5}}, {{"acl_tear", "femoral"}}, "left"};
  EXPECT_EQ(command_of(order_of(recipe_of(order))), command_of(order));
  EXPECT_EQ(command_of(order),
            "osteon anatomy make knee --seed 7 --set size_percent=104.5 --finding "
            "acl_tear=femoral --side left");
}

}  // namespace
}  // namespace osteon
