#include "osteon/device/closed_loop.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace osteon {
namespace {

DeviceInfo device() {
  DeviceInfo info;
  info.peak_force_n = 8;
  info.continuous_force_n = 8;
  return info;
}

std::string name(const WallTrial& t) {
  return "mass " + std::to_string(t.hand.mass_kg) + " grip " +
         std::to_string(t.hand.grip_stiffness_n_per_m) + " damping " +
         std::to_string(t.hand.grip_damping_n_s_per_m) + " wall " + std::to_string(t.wall_n_per_m) +
         " delay " + std::to_string(t.delay_s) + (t.delay_before ? " before" : " behind");
}

// Hands from the lightest to the heaviest and from the loosest to the firmest, walls from 0.5 to
// 10 N/mm, delays from none to 3 ms on either side of the gate.
std::vector<WallTrial> all_trials() {
  std::vector<WallTrial> out;
  for (const double mass : {0.05, 0.15, 0.5})
    for (const double grip : {50.0, 500.0, 1500.0})
      for (const double damping : {2.0, 12.0})
        for (const double wall : {500.0, 2000.0, 5000.0, 10000.0})
          for (const double delay : {0.0, 0.001, 0.002, 0.003})
            for (const bool before : {false, true}) {
              WallTrial trial;
              trial.hand = {mass, grip, damping};
              trial.wall_n_per_m = wall;
              trial.delay_s = delay;
              trial.delay_before = before;
              if (delay > 0 || !before) out.push_back(trial);
            }
  return out;
}

TEST(ClosedLoop, AWallThatIsNoneAndAHandThatStaysAwayAreAtRest) {
  WallTrial trial;
  trial.press_n = 0;
  trial.seconds = 1;
  const WallOutcome out = press_wall(trial, device());
  EXPECT_TRUE(out.settled());
  EXPECT_NEAR(out.force_n, 0, 0.01);
}

TEST(ClosedLoop, AnEasyWallIsFeltWholly) {
  WallTrial trial;
  trial.wall_n_per_m = 1000;
  const WallOutcome out = press_wall(trial, device());
  EXPECT_LT(out.swing_m, 1e-6);
  EXPECT_NEAR(out.force_n, 3, 0.001);
  EXPECT_NEAR(out.depth_m, 0.003, 1e-6);
  EXPECT_EQ(out.passivity.stiffness_share, 1);
}

TEST(ClosedLoop, WithTheControllerEveryHandSettlesOnEveryWallAtEveryDelay) {
  for (const WallTrial& trial : all_trials()) {
    const WallOutcome out = press_wall(trial, device());
    EXPECT_EQ(out.cause, ForceOff::kNone) << name(trial);
    EXPECT_LT(out.swing_m, 2e-5) << name(trial);
    EXPECT_GT(out.force_n, 0.02) << name(trial);
  }
}

// The test above would say little if these loops were calm by themselves.
TEST(ClosedLoop, WithoutItManyOfThemSwing) {
  int swinging = 0, trials = 0;
  for (WallTrial trial : all_trials()) {
    trial.filtered = false;
    trial.seconds = 4;
    const WallOutcome out = press_wall(trial, device());
    swinging += out.settled() || out.swing_m < 0.8 * out.earlier_swing_m ? 0 : 1;
    ++trials;
  }
  EXPECT_GT(swinging, trials / 4);
}

// Damping alone is not enough where the force comes late: what the stiffness share is for.
TEST(ClosedLoop, ObserverAndDampingAloneDoNotHoldALateStiffWall) {
  WallTrial trial;
  trial.hand = {0.15, 500, 12};
  trial.wall_n_per_m = 10000;
  trial.delay_s = 0.003;
  SafetyParams params;
  params.passivity.lower_stiffness = false;
  EXPECT_GT(press_wall(trial, device(), params).swing_m, 0.001);
  EXPECT_LT(press_wall(trial, device()).swing_m, 2e-5);
}

// Colgate and Brown's bound, for a wall that the gate leaves alone: K T / 2 < b, with the delay on
// top: K (T / 2 + delay) < b.
TEST(ClosedLoop, TheUnfilteredLoopObeysTheBoundOfSampledWalls) {
  for (const double delay : {0.0, 0.001, 0.003}) {
    WallTrial trial;
    trial.hand = {0.15, 500, 12};
    trial.filtered = false;
    trial.delay_s = delay;
    trial.wall_n_per_m = 0.8 * 12 / (0.0005 + delay);
    if (trial.wall_n_per_m > 15000) trial.wall_n_per_m = 15000;
    EXPECT_LT(press_wall(trial, device()).swing_m, 2e-5) << delay;
  }
}

}  // namespace
}  // namespace osteon
