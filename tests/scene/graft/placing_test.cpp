// Tunnels of a case are found by their landmarks and the bone about them, and what is seen of a
// graft follows the state.
#include "osteon/scene/placing.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

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

// Blocks without holes: the axis leaves them where their faces are.
TEST(PlanPlacing, MeasuresFromWholeBonesAlongTheAxesOfTheHoles) {
  auto def = testing::placing_def();
  const Case knee = *build_case(std::move(def));
  const auto at_F = [&](double x) { return knee.bones[0].X_WB.inverse() * Vec3(x, 0, 0); };
  const auto at_T = [&](double z) { return knee.bones[1].X_WB.inverse() * Vec3(0, 0, z); };
  const PlacingHole tibia{at_T(-0.066), at_T(-0.034), 0.008};
  const PlacingHole socket{at_F(0.003), at_F(0.025), 0.009};
  const auto plan = plan_placing(knee, socket, tibia);
  ASSERT_TRUE(plan);
  EXPECT_NEAR((plan->femur.mouth_B - at_F(0)).norm(), 0, 1e-9);
  EXPECT_NEAR((plan->femur.outer_B - at_F(0.040)).norm(), 0, 1e-9);
  EXPECT_NEAR((plan->tibia.mouth_B - at_T(-0.030)).norm(), 0, 1e-9);
  EXPECT_NEAR((plan->tibia.outer_B - at_T(-0.070)).norm(), 0, 1e-9);
  EXPECT_NEAR(plan->socket_m, 0.025, 1e-9);
  EXPECT_NEAR(plan->between_m, 0.030, 1e-9);
  EXPECT_NEAR(plan->graft_m, 0.008, 1e-12);
  EXPECT_NEAR(plan->femur_bend_rad, std::acos(0.0), 1e-9);
  EXPECT_NEAR(plan->tibia_bend_rad, 0, 1e-9);
  // The ends of a hole come in any order.
  const auto turned = plan_placing(knee, {socket.to_B, socket.from_B, 0.009},
                                   {tibia.to_B, tibia.from_B, 0.008}, {0.007, 0.09, 0.025});
  ASSERT_TRUE(turned);
  EXPECT_NEAR((turned->femur.mouth_B - plan->femur.mouth_B).norm(), 0, 1e-12);
  EXPECT_NEAR((turned->tibia.mouth_B - plan->tibia.mouth_B).norm(), 0, 1e-12);
  EXPECT_EQ(turned->graft_m, 0.007);
  EXPECT_EQ(turned->loop_m, 0.025);
  EXPECT_FALSE(plan_placing(knee, socket, {Vec3(1, 0, 0), Vec3(1.1, 0, 0), 0.008}));
  EXPECT_FALSE(plan_placing(knee, {Vec3::Zero(), Vec3::Zero(), 0.008}, tibia));
}

TEST(PlanPlacing, NumbersTellThePlanToTheBit) {
  const Case knee = *build_case(testing::placing_def());
  const auto plan = find_placing(knee);
  ASSERT_TRUE(plan);
  const PlacingNumbers numbers = placing_numbers(*plan);
  const auto again = plan_of_numbers(knee, numbers);
  ASSERT_TRUE(again);
  EXPECT_EQ(placing_numbers(*again), numbers);
  EXPECT_EQ(again->between_m, plan->between_m);
  EXPECT_EQ(again->femur_bend_rad, plan->femur_bend_rad);
  for (const double bad : {std::numeric_limits<double>::quiet_NaN(), 1e9}) {
    PlacingNumbers odd = numbers;
    odd[3] = bad;
    EXPECT_FALSE(plan_of_numbers(knee, odd));
  }
  PlacingNumbers none = numbers;
  none[15] = 0;
  EXPECT_FALSE(plan_of_numbers(knee, none));
}

TEST(PlacingRods, ShowWhatLiesInTheKnee) {
  using Is = PlacingRod::Is;
  const auto plan = find_placing(*placing_knee());
  ASSERT_TRUE(plan);
  BoneSnapshot bones = rest_snapshot(*placing_knee());
  EXPECT_TRUE(placing_rods(bones).empty());
  bones.placing.on = true;
  bones.placing.plan = *plan;
  EXPECT_TRUE(placing_rods(bones).empty());
  bones.placing.phase = PlacingPhase::kThreadInside;
  bones.placing.end_W = Vec3(-0.02, 0, 0);
  auto rods = placing_rods(bones);
  ASSERT_FALSE(rods.empty());
  EXPECT_EQ(rods[0].a_W, bones.placing.end_W);
  EXPECT_EQ(length_of(rods, Is::kGraft), 0);
  bones.placing.phase = PlacingPhase::kThreadOut;
  bones.placing.drawn_m = 0.060;
  rods = placing_rods(bones);
  EXPECT_NEAR(length_of(rods, Is::kGraft), 0.120, 1e-9);
  EXPECT_NEAR(length_of(rods, Is::kButton), 0.012, 1e-9);
  EXPECT_NEAR(length_of(rods, Is::kLoop), 0.020, 1e-9);
  bones.placing.phase = PlacingPhase::kTurned;
  bones.placing.gap_m = 0.003;
  rods = placing_rods(bones);
  const PlacingRod& button = rods.back();
  ASSERT_EQ(button.is, Is::kButton);
  EXPECT_NEAR(std::abs((button.b_W - button.a_W).normalized().x()), 0, 1e-9);
  EXPECT_NEAR(button.a_W.x() - button.radius_m, 0.043, 1e-9);
}

}  // namespace
}  // namespace osteon
