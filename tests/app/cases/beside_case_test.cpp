#include "cases/beside_case.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "osteon/scene/graft_bench.h"

namespace osteon {
namespace {

CaseDef knee_of_a_block(const std::string& side) {
  CaseDef def;
  def.name = "block";
  def.side = side;
  BoneDef bone;
  bone.name = "femur";
  bone.mesh.vertices = {{0, 0, 0}, {0.1, 0, 0}, {0, 0.1, 0}, {0, 0, 0.1}};
  bone.mesh.triangles = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};
  bone.felt = Felt::kHull;
  def.bones.push_back(std::move(bone));
  def.recipe = CaseRecipe{"knee", 7, side, {}, {}};
  return def;
}

TEST(BesideCase, NothingOrSomethingUnknown) {
  CaseDef def = knee_of_a_block("right");
  ASSERT_TRUE(lay_beside("", def));
  EXPECT_EQ(def.bones.size(), 1u);
  const auto odd = lay_beside("kitchen", def);
  ASSERT_FALSE(odd);
  EXPECT_NE(odd.error().todo.find("graft_bench"), std::string::npos);
}

TEST(BesideCase, NoNameComesTwice) {
  CaseDef def = knee_of_a_block("right");
  def.bones[0].name = "thigh";
  EXPECT_FALSE(lay_beside("graft_bench", def));
  def = knee_of_a_block("right");
  def.landmarks.push_back({"hook", Vec3::Zero()});
  EXPECT_FALSE(lay_beside("graft_bench", def));
}

// The patient's tendons, on the inner side; what lies there does not frame the patient.
TEST(BesideCase, ABenchLiesBesideTheKneeOfEitherSide) {
  for (const char* side : {"left", "right"}) {
    CaseDef def = knee_of_a_block(side);
    ASSERT_TRUE(lay_beside("graft_bench", def));
    const auto mark = std::find_if(def.landmarks.begin(), def.landmarks.end(),
                                   [](const Landmark& l) { return l.name == "graft_from"; });
    ASSERT_NE(mark, def.landmarks.end());
    EXPECT_GT(std::abs(mark->p_W.y()), 0.3) << "out of the way of what is used at the knee";
    EXPECT_EQ(mark->p_W.y() > 0, std::string(side) == "right");
    const auto built = build_case(std::move(def));
    ASSERT_TRUE(built) << built.error().message();
    EXPECT_LT(built->bounds_W().extent().maxCoeff(), 0.11);
    EXPECT_TRUE(find_graft_bench(*built).has_value());
    EXPECT_FALSE(built->bones[0].beside);
    EXPECT_TRUE(built->bone(built->find("thigh")).beside);
    EXPECT_FALSE(built->find("knob_cortex").valid());  // this knee has a channel of its own
  }
}

}  // namespace
}  // namespace osteon
