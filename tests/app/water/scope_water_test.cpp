#include "water/joint_water.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace osteon {
namespace {

ByTissue gone(double cortical_mm3, double cancellous_mm3) {
  ByTissue out{};
  out[static_cast<std::size_t>(BoneTissue::kCortical)] = 1e-9 * cortical_mm3;
  out[static_cast<std::size_t>(BoneTissue::kCancellous)] = 1e-9 * cancellous_mm3;
  return out;
}

// From `from_s` for `for_s` at 30 pictures a second, as much gone as there is.
void wait(JointWater& water, double from_s, double for_s, double suction, const ByTissue& removed) {
  for (int k = 1; k <= std::lround(30 * for_s); ++k)
    water.go_to(from_s + k / 30.0, {suction}, removed);
}

TEST(JointWater, BeginsDistendedAndClearAndStaysSo) {
  JointWater water(knee_fluid());
  const double rest_pa = water.state().pressure_pa;
  // What flows in flows out: 8 (60 - p) = (2 + 0.3) p, mmHg.
  EXPECT_NEAR(rest_pa / kPa_per_mmHg, 8 * 60 / 10.3, 0.1);
  water.go_to(0, {0}, {});
  wait(water, 0, 20, 0, {});
  EXPECT_NEAR(water.state().pressure_pa, rest_pa, 1);
  EXPECT_EQ(water.seen(), ScopeWater());
  EXPECT_EQ(water.state().obscured_s, 0);
}

TEST(JointWater, CorticalBoneGivesPaleSlurryThatTheFlowTakesAway) {
  JointWater water(knee_fluid());
  water.go_to(0, {0}, {});
  wait(water, 0, 1, 0, gone(200, 0));
  const double clouded = water.turbidity();
  EXPECT_GT(clouded, 0.05);
  EXPECT_EQ(water.seen().blood, 0) << "hard bone hardly bleeds";
  // Of 80 ml, 104 ml go out each minute.
  const double share = water.state().debris;
  wait(water, 1, 30, 0, gone(200, 0));
  const double flow_ml_min = 8 * (60 - water.state().pressure_pa / kPa_per_mmHg);
  EXPECT_NEAR(water.state().debris / share, std::exp(-flow_ml_min / 80 * 0.5), 0.02);
}

TEST(JointWater, OpenedSoftBoneBleedsLessUnderPressureAndSuctionClears) {
  const auto after_five_minutes = [](double pump_mmhg, double suction) {
    JointWater water(knee_fluid());
    water.set({kPa_per_mmHg * pump_mmhg, 0.5});
    water.go_to(0, {0}, {});
    wait(water, 0, 300, suction, gone(0, 1500));
    return water;
  };
  const JointWater usual = after_five_minutes(60, 0), high = after_five_minutes(90, 0);
  EXPECT_GT(usual.seen().blood, 0.5);
  EXPECT_GT(usual.turbidity(), 0.02);
  EXPECT_LT(high.turbidity(), 0.5 * usual.turbidity());
  EXPECT_LT(after_five_minutes(60, 0.3).turbidity(), usual.turbidity());
  EXPECT_GT(after_five_minutes(10, 0).state().obscured_s, 30)
      << "too little to hold the joint open";
}

TEST(JointWater, WhereTimeOrBoneGoesBackItIsClearAgain) {
  JointWater water(wrist_fluid());
  const auto cloud = [&] {
    water.go_to(10, {0}, {});
    wait(water, 10, 1, 0, gone(50, 50));
    EXPECT_GT(water.turbidity(), 0.05);
  };
  cloud();
  water.go_to(5, {0}, gone(50, 50));
  EXPECT_EQ(water.turbidity(), 0);
  cloud();
  water.go_to(11.1, {0}, gone(20, 50));
  EXPECT_EQ(water.turbidity(), 0) << "undone";
  cloud();
  water.go_to(400, {0}, gone(50, 50));
  EXPECT_EQ(water.turbidity(), 0) << "a leap";
}

TEST(JointWater, NumbersThatAreNoneChangeNothing) {
  const double nan = std::nan("");
  JointWater water(knee_fluid());
  const double before_pa = water.state().pressure_pa;
  water.set({nan, 0.5});
  water.set({8000, 1.5});
  EXPECT_EQ(water.settings().pump_pa, WaterSettings().pump_pa);
  water.go_to(nan, {0}, {});
  water.go_to(0, {nan}, gone(0, 0));
  water.go_to(0.03, {nan}, gone(nan, nan));
  EXPECT_NEAR(water.state().pressure_pa, before_pa, 1);
  EXPECT_TRUE(std::isfinite(water.turbidity()));
}

TEST(JointWater, WhatToolsDoIsKnownByTheInstrumentAndItsPower) {
  const auto which =
      water_tools_of({"hook_probe", "shaver", "wrist_probe", "no_such_thing", "cannulated_drill"});
  ASSERT_TRUE(which) << which.error().message();
  EXPECT_EQ(*which,
            WaterTools({{false, true, false, false, false}, {false, true, false, false, true}}));
  std::array<ToolState, 3> tools{};
  tools[0].instrument = 0;
  tools[0].power = 1;
  EXPECT_EQ(deeds_of(*which, tools).suction, 0);
  EXPECT_EQ(deeds_of(*which, tools).share_into_joint, 1);
  tools[1].instrument = 1;
  tools[1].power = 0.4;
  tools[1].portal = 0;
  tools[2].instrument = 77;
  tools[2].power = 1;
  EXPECT_EQ(deeds_of(*which, tools).suction, 0.4);
  tools[1].power = std::nan("");
  EXPECT_EQ(deeds_of(*which, tools).suction, 0);
}

TEST(JointWater, ADrillFromOutsideLeavesAFifthOfItsChipsInside) {
  const WaterTools which{{false, false}, {false, true}};
  std::array<ToolState, 2> tools{};  // a scope in its portal and a drill
  tools[0].power = 1;
  tools[0].portal = 0;
  tools[1].instrument = 1;
  tools[1].power = 1;
  EXPECT_EQ(deeds_of(which, tools).share_into_joint, 0.2);
  double taken[2];
  for (const bool inside : {false, true}) {
    tools[1].portal = inside ? 1 : kNoPortal;
    JointWater water(knee_fluid());
    water.go_to(0, {}, {});
    water.go_to(0.1, deeds_of(which, tools), gone(100, 0));
    taken[inside] = water.state().debris;
  }
  EXPECT_NEAR(taken[0] / taken[1], 0.2, 0.001);
}

}  // namespace
}  // namespace osteon
