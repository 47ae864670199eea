// Tunnels of a case are found by their landmarks and the bone about them, and what is seen of a
// graft follows the state.
#include "osteon/scene/placing.h"

#include <gtest/gtest.h>

#include "placing_case.h"

namespace osteon {
namespace {

using testing::placing_def;
using testing::placing_knee;

TEST(FindPlacing, MeasuresTheTunnelsInTheirBones) {
  const auto plan = find_placing(*placing_knee());
  ASSERT_TRUE(plan);
  const Pose X_WF = placing_knee()->bones[0].X_WB, X_WT = placing_knee()->bones[1].X_WB;
  EXPECT_NEAR((X_WF * plan->femur.mouth_B).norm(), 0, 1e-9);
  EXPECT_NEAR(plan->femur.length_m(), 0.040, 1e-9);
  EXPECT_NEAR((X_WT * plan->tibia.mouth_B - Vec3(0, 0, -0.030)).norm(), 0, 1e-9);
  EXPECT_NEAR(plan->tibia.length_m(), 0.040, 1e-9);
  EXPECT_NEAR(plan->socket_m, 0.026, 1e-9);
  EXPECT_NEAR(plan->between_m, 0.030, 1e-9);
  EXPECT_NEAR(plan->femur_bend_rad, 1.5707963, 1e-6);
  EXPECT_NEAR(plan->tibia_bend_rad, 0, 1e-6);
  EXPECT_NEAR(plan->graft_m, 0.008, 1e-9);
  EXPECT_NEAR(plan->loop_m, 0.020, 1e-9);
  EXPECT_NEAR(plan->button_out_m(), 0.040 + 0.030 + 0.040 + 0.012, 1e-9);
}

TEST(FindPlacing, ACaseWithoutAMarkOrBoneHasNone) {
  for (std::size_t i = 0; i < placing_def().landmarks.size(); ++i) {
    CaseDef def = placing_def();
    def.landmarks.erase(def.landmarks.begin() + static_cast<std::ptrdiff_t>(i));
    EXPECT_FALSE(find_placing(*build_case(std::move(def)))) << i;
  }
  CaseDef def = placing_def();
  def.bones[1].name = "fibula";
  EXPECT_FALSE(find_placing(*build_case(std::move(def))));
  def = placing_def();
  def.landmarks[1].p_W.x() = 0.004;  // a socket so short that no loop lets the button turn
  EXPECT_FALSE(find_placing(*build_case(std::move(def))));
}

double length_of(const std::vector<PlacingRod>& rods, PlacingRod::Is is) {
  double sum = 0;
  for (const PlacingRod& rod : rods)
    if (rod.is == is) sum += (rod.b_W - rod.a_W).norm();
  return sum;
}

TEST(PlacingRods, ShowWhatLiesInTheKnee) {
  using Is = PlacingRod::Is;
  const auto plan = find_placing(*placing_knee());
  ASSERT_TRUE(plan);
  BoneSnapshot bones = rest_snapshot(*placing_knee());
  EXPECT_TRUE(placing_rods(*plan, bones).empty());
  bones.placing.on = true;
  EXPECT_TRUE(placing_rods(*plan, bones).empty());
  bones.placing.phase = PlacingPhase::kThreadInside;
  bones.placing.end_W = Vec3(-0.02, 0, 0);
  auto rods = placing_rods(*plan, bones);
  ASSERT_FALSE(rods.empty());
  EXPECT_EQ(rods[0].a_W, bones.placing.end_W);
  EXPECT_EQ(length_of(rods, Is::kGraft), 0);
  bones.placing.phase = PlacingPhase::kThreadOut;
  bones.placing.drawn_m = 0.060;
  rods = placing_rods(*plan, bones);
  EXPECT_NEAR(length_of(rods, Is::kGraft), 0.120, 1e-9);
  EXPECT_NEAR(length_of(rods, Is::kButton), 0.012, 1e-9);
  EXPECT_NEAR(length_of(rods, Is::kLoop), 0.020, 1e-9);
  bones.placing.phase = PlacingPhase::kTurned;
  bones.placing.gap_m = 0.003;
  rods = placing_rods(*plan, bones);
  const PlacingRod& button = rods.back();
  ASSERT_EQ(button.is, Is::kButton);
  EXPECT_NEAR(std::abs((button.b_W - button.a_W).normalized().x()), 0, 1e-9);
  EXPECT_NEAR(button.a_W.x() - button.radius_m, 0.043, 1e-9);
}

}  // namespace
}  // namespace osteon
