#include "exercises/scenario_files.h"

#include <gtest/gtest.h>

#include <array>

#include "../../session/drilling.h"
#include "runs/hands/tray.h"

namespace osteon {
namespace {

TEST(ScenarioFiles, WhatIsNotOneIsToldByName) {
  const auto none = open_scenario("no_such_exercise");
  ASSERT_FALSE(none);
  EXPECT_NE(none.error().message().find("no_such_exercise"), std::string::npos);
}

// The shell's thickness and the water reach what removes bone, in the window as headless.
TEST(ScenarioFiles, BonesAreRemovedAsTheScenarioSays) {
  Scenario scenario;
  EXPECT_EQ(carve_settings(scenario), CarveSettings{});
  scenario.cortex_mm = 3;
  scenario.irrigation_ml_per_min = 60;
  const CarveSettings carve = carve_settings(scenario);
  const std::array<std::string, 1> tray{"drill:3.2"};
  const auto made = carving_for_run(*testing::drilled_block(), tray, carve);
  ASSERT_TRUE(made && *made) << (made ? "nothing can be carved" : made.error().message());
  EXPECT_DOUBLE_EQ((*made)->irrigation_m3_s, 1e-6);
  const auto usual = carving_for_run(*testing::drilled_block(), tray);
  ASSERT_TRUE(usual && *usual);
  EXPECT_EQ((*usual)->irrigation_m3_s, 0);
  EXPECT_EQ((*made)->layers.at(0.002), BoneTissue::kCortical);
  EXPECT_EQ((*usual)->layers.at(0.002), BoneTissue::kCancellous);
}

}  // namespace
}  // namespace osteon
