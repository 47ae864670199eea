#include "osteon/carve/thrust.h"

#include <gtest/gtest.h>

#include <cmath>

#include "osteon/carve/drill_trial.h"

namespace osteon {
namespace {

const DrillTable& table() {
  static const DrillTable loaded = [] {
    auto t = load_drill_table(std::filesystem::path(OSTEON_SOURCE_DIR) /
                              "assets/materials/drilling.toml");
    EXPECT_TRUE(t) << t.error().message();
    return t ? *t : DrillTable{};
  }();
  return loaded;
}

const DrillMaterial& cortex() { return *table().find("cortical_bone"); }

TEST(DrillTableText, WhatIsWrongIsNamed) {
  EXPECT_FALSE(parse_drill_table("", "x"));
  EXPECT_FALSE(parse_drill_table("[usual]\ndiameter_m = 3\n", "x"));
  EXPECT_FALSE(parse_drill_table("[nothing", "x"));
}

TEST(Thrust, AndTorqueLieInThePublishedRangesAtTheUsualFeed) {
  const DrillTool tool{table().usual_diameter_m, table().usual_speed_rev_per_s, 0, 0};
  const double feed = table().usual_feed_m_per_rev;
  struct Range {
    const char* material;
    double lo_n, hi_n;
  };
  for (const Range& r : {Range{"cortical_bone", 140, 186}, Range{"metaphyseal_cortex", 0, 50},
                         Range{"cancellous_bone", 1, 1.5}}) {
    const double thrust = thrust_for(table(), *table().find(r.material), tool, feed);
    EXPECT_GE(thrust, r.lo_n) << r.material;
    EXPECT_LE(thrust, r.hi_n) << r.material;
  }
  for (const char* name : {"cortical_bone", "metaphyseal_cortex"}) {
    const double torque = torque_for(table(), *table().find(name), tool, feed);
    EXPECT_GE(torque, 10e-3) << name;
    EXPECT_LE(torque, 55e-3) << name;
  }
}

TEST(Thrust, TheSpecificEnergyComesBackFromTheTorque) {
  const DrillTool tool;
  const double f = 4e-5, D = tool.diameter_m;
  const double rub = torque_for(table(), cortex(), tool, 0);
  const double u = 8 * (torque_for(table(), cortex(), tool, f) - rub) / (f * D * D);
  EXPECT_NEAR(u / cortex().specific_energy_j_per_m3, 1, 1e-12);
}

TEST(Thrust, FeedIsWhatTheThrustAllows) {
  const DrillTool tool;
  DrillState state;
  const double wanted = thrust_for(table(), cortex(), tool, 3e-5);
  const DrillStep step = step_drill(state, table(), tool, {&cortex(), 0}, wanted, 0.001);
  EXPECT_NEAR(step.feed_m_per_rev, 3e-5, 1e-12);
  EXPECT_NEAR(step.advance_m, 3e-5 * tool.speed_rev_per_s * 0.001, 1e-15);
  EXPECT_EQ(state.depth_m, step.advance_m);
  EXPECT_EQ(step.resistance_n, wanted);
}

TEST(Thrust, BluntBackwardsStillOrTooLightRemovesNothing) {
  DrillTool blunt, backwards, still;
  blunt.bluntness = 1;
  backwards.speed_rev_per_s = -16;
  still.speed_rev_per_s = 0;
  for (const DrillTool& tool : {blunt, backwards, still}) {
    DrillState state;
    const DrillStep step = step_drill(state, table(), tool, {&cortex(), 0}, 100, 0.001);
    EXPECT_EQ(step.advance_m, 0);
    EXPECT_EQ(state.depth_m, 0);
    EXPECT_EQ(step.resistance_n, 100);
  }
  DrillState state;
  EXPECT_EQ(step_drill(state, table(), {}, {&cortex(), 0}, 1, 0.001).advance_m, 0);
  DrillTool worn;
  worn.bluntness = 0.3;
  DrillState a, b;
  EXPECT_LT(step_drill(a, table(), worn, {&cortex(), 0}, 100, 0.001).advance_m,
            step_drill(b, table(), {}, {&cortex(), 0}, 100, 0.001).advance_m);
}

TEST(Thrust, AShallowAngleSkivesUnlessAStartWasMade) {
  const double shallow = 60 * M_PI / 180;
  DrillState none, made;
  made.depth_m = 0.0006;
  EXPECT_TRUE(step_drill(none, table(), {}, {&cortex(), shallow}, 60, 0.001).skives);
  EXPECT_EQ(none.depth_m, 0);
  const DrillStep step = step_drill(made, table(), {}, {&cortex(), shallow}, 60, 0.001);
  EXPECT_FALSE(step.skives);
  EXPECT_GT(step.advance_m, 0);
  EXPECT_FALSE(step_drill(none, table(), {}, {&cortex(), 0.2}, 60, 0.001).skives);
}

TEST(Thrust, ReamersChatterInCortexAboveADepthOfCut) {
  EXPECT_FALSE(reamer_chatter(table(), 10e-3, 9.8e-3, 5, true));
  EXPECT_FALSE(reamer_chatter(table(), 11e-3, 9.8e-3, 5, false));
  EXPECT_FALSE(reamer_chatter(table(), 11e-3, 9.8e-3, 0, true));
  const auto some = reamer_chatter(table(), 11e-3, 9.8e-3, 5, true);
  const auto more = reamer_chatter(table(), 11.5e-3, 9.8e-3, 5, true);
  ASSERT_TRUE(some && more);
  EXPECT_EQ(some->frequency_hz, 30);
  EXPECT_GT(more->amplitude_m, some->amplitude_m);
  EXPECT_LE(reamer_chatter(table(), 20e-3, 9e-3, 5, true)->amplitude_m, 0.2e-3);
}

std::vector<DrillLayer> shaft() {
  return {{"cortical_bone", 3e-3}, {"cancellous_bone", 10e-3}, {"cortical_bone", 3e-3}};
}

DrillTrial trial_of(const DrillHand& hand, const DrillTool& tool = {},
                    const DrillTrialOptions& options = {}) {
  auto t = run_drill_trial(table(), shaft(), tool, hand, options);
  EXPECT_TRUE(t) << t.error().message();
  return t ? *t : DrillTrial{};
}

TEST(DrillTrial, RefusesWhatIsNone) {
  EXPECT_FALSE(run_drill_trial(table(), {}, {}, {}));
  EXPECT_FALSE(run_drill_trial(table(), {{"cheese", 1e-3}}, {}, {}));
  EXPECT_FALSE(run_drill_trial(table(), {{"cortical_bone", 0}}, {}, {}));
  DrillHand weightless;
  weightless.mass_kg = 0;
  EXPECT_FALSE(run_drill_trial(table(), shaft(), {}, weightless));
}

TEST(DrillTrial, AHandOf40NewtonsShowsEntryCancellousFarCortexAndTheDrop) {
  const DrillTrial t = trial_of({});
  ASSERT_TRUE(t.through);
  double seconds[3] = {0, 0, 0};
  for (std::size_t i = 1; i < t.samples.size(); ++i) {
    const DrillSample& s = t.samples[i];
    // The tip is never deeper than the drill has cleared, but for the bone's give.
    if (s.removed_m < 16e-3) {
      EXPECT_LT(s.tip_m, s.removed_m + 0.5e-3);
    }
    if (s.removed_m > 0.5e-3 && s.removed_m < 2.9e-3) {
      EXPECT_NEAR(s.resistance_n, 40, 1);
    }
    seconds[s.removed_m < 3e-3 ? 0 : s.removed_m < 13e-3 ? 1 : 2] += 0.05;
  }
  EXPECT_GT(seconds[0], 5 * seconds[1]);  // three times as far, in a fraction of the time
  EXPECT_NEAR(seconds[2] / seconds[0], 1, 0.25);
  EXPECT_EQ(t.samples.back().resistance_n, 0);
}

TEST(DrillTrial, AnExpertPlungesAboutFiveMillimetresAndANoviceMore) {
  DrillHand expert, novice;
  expert.drop_n = 5.5;
  const double deep_expert = trial_of(expert).plunge_m, deep_novice = trial_of(novice).plunge_m;
  EXPECT_NEAR(deep_expert, 5.3e-3, 0.7e-3);
  EXPECT_GT(deep_novice, deep_expert + 0.5e-3);
  EXPECT_LT(deep_novice, 10e-3);
}

DrillTrial heated(double thrust_n, double pilot_m = 0, bool water = false) {
  DrillHand hand;
  hand.thrust_n = thrust_n;
  DrillTool tool;
  tool.pilot_diameter_m = pilot_m;
  DrillTrialOptions options;
  options.heat = true;
  options.water = water;
  auto t = run_drill_trial(table(), {{"cortical_bone", 4e-3}}, tool, hand, options);
  EXPECT_TRUE(t);
  return t ? *t : DrillTrial{};
}

TEST(DrillTrial, LightThrustIsHotterThanFirm) {
  EXPECT_GT(heated(10).hottest_c, 45);
  EXPECT_GT(heated(20).hottest_c, 45);  // with 40 the findings' nearest pair
  EXPECT_LT(heated(40).hottest_c, 45);
  EXPECT_LT(heated(60).hottest_c, 45);
}

TEST(DrillTrial, APilotHoleAndWaterLowerTheTemperature) {
  const double plain = heated(20).hottest_c;
  EXPECT_LT(heated(20, 2.5e-3).hottest_c, plain - 3);
  EXPECT_LT(heated(20, 0, true).hottest_c, plain - 1);
}

}  // namespace
}  // namespace osteon
