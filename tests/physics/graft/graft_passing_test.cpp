#include "osteon/physics/graft_passing.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

namespace osteon {
namespace {

constexpr double kPassingDeg = std::numbers::pi / 180;

PassedGraft passed(const PassingWay& way, const DrawnGraft& graft) {
  const auto found = pass_graft(way, graft);
  EXPECT_TRUE(found) << (found ? "" : found.error().message());
  return found.value_or(PassedGraft{});
}

// A graft with play in both tunnels: the capstan alone. Thread lies on both edges at first, tendon
// at last.
TEST(GraftPassing, ALooseGraftPullsAsTheCapstanOfBothTurns) {
  PassingWay way;
  way.tibia_bend_rad = 30 * kPassingDeg;
  way.femur_bend_rad = 60 * kPassingDeg;
  DrawnGraft graft;
  graft.diameter_m = 0.007;
  const double turn = std::numbers::pi / 2;
  EXPECT_NEAR(passing_pull_n(way, graft, 0), 10 * std::exp(0.2 * turn), 1e-9);
  // The tendon has come to the knee, not yet to the femur.
  EXPECT_NEAR(passing_pull_n(way, graft, 0.040 + 0.010 + 0.026),
              10 * std::exp(0.1 * turn / 3 + 0.2 * turn * 2 / 3), 1e-9);
  const PassedGraft whole = passed(way, graft);
  EXPECT_NEAR(whole.last_pull_n, 10 * std::exp(0.1 * turn), 1e-9);
  EXPECT_NEAR(whole.most_pull_n, 10 * std::exp(0.2 * turn), 1e-9);
}

// On a straight way only the walls drag: 0.5 N for each mm of tendon in them.
TEST(GraftPassing, OnAStraightWayTheWallsDragByTheTendonInThem) {
  DrawnGraft graft;
  graft.tail_n = 0;
  const PassingWay way;
  EXPECT_EQ(passing_pull_n(way, graft, 0.020), 0);  // no tendon has come in
  EXPECT_NEAR(passing_pull_n(way, graft, 0.026 + 0.012), 6, 1e-9);
  EXPECT_NEAR(passing_pull_n(way, graft, 0.026 + 0.055), 20, 1e-9);
  const PassedGraft whole = passed(way, graft);
  EXPECT_TRUE(whole.turns);
  EXPECT_NEAR(whole.end_m, 0.040 + 0.030 + 0.040 + 0.012, 1e-12);
  EXPECT_NEAR(whole.most_pull_n, 0.5 * (40 + 26), 1e-6);
  graft.diameter_m = 0.0085;
  EXPECT_NEAR(passed(way, graft).most_pull_n, 1.5 * 0.5 * (40 + 26), 1e-6);
  // Its tail has left the tibia by half when the button is out.
  graft.diameter_m = 0.008;
  graft.length_m = 0.076;
  EXPECT_NEAR(passed(way, graft).last_pull_n, 0.5 * (20 + 26), 1e-6);
  // A short one leaves the tibia altogether; the tibia drags most.
  graft.length_m = 0.050;
  EXPECT_NEAR(passed(way, graft).last_pull_n, 0.5 * 26, 1e-6);
  EXPECT_NEAR(passed(way, graft).most_pull_n, 0.5 * 40, 1e-6);
}

TEST(GraftPassing, TheLargestPullIsThatOfManyPlaces) {
  PassingWay way;
  way.tibia_bend_rad = 50 * kPassingDeg;
  way.femur_bend_rad = 70 * kPassingDeg;
  for (const double length : {0.020, 0.045, 0.070, 0.120}) {
    DrawnGraft graft;
    graft.length_m = length;
    const PassedGraft whole = passed(way, graft);
    double most = 0;
    for (int i = 0; i <= 20000; ++i)
      most = std::max(most, passing_pull_n(way, graft, whole.end_m * i / 20000));
    EXPECT_GE(whole.most_pull_n, most - 1e-9) << length;
    EXPECT_NEAR(whole.most_pull_n, most, 0.02) << length;
    EXPECT_NEAR(passing_pull_n(way, graft, whole.most_pull_at_m), whole.most_pull_n, 1e-9);
  }
}

TEST(GraftPassing, ALoopThatIsTooShortKeepsTheButtonInTheBone) {
  DrawnGraft graft;
  graft.loop_m = 0.015;
  const PassedGraft short_loop = passed({}, graft);
  EXPECT_FALSE(short_loop.turns);
  EXPECT_NEAR(short_loop.end_m, 0.040 + 0.030 + 0.026 + 0.015 + 0.006, 1e-12);
  EXPECT_NE(short_loop.why.find("5.0 mm"), std::string::npos) << short_loop.why;
  graft.loop_m = 0.020;
  EXPECT_TRUE(passed({}, graft).turns);
}

TEST(GraftPassing, WhatIsNoNumberOutOfRangeOrTooThickIsRefused) {
  PassingWay way;
  way.femur_bend_rad = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(pass_graft(way, {}));
  DrawnGraft graft;
  graft.tail_n = -1;
  ASSERT_FALSE(pass_graft({}, graft));
  EXPECT_NE(pass_graft({}, graft).error().message().find("tail"), std::string::npos);
  graft = {};
  graft.diameter_m = 0.009;
  ASSERT_FALSE(pass_graft({}, graft));
  EXPECT_NE(pass_graft({}, graft).error().message().find("thicker"), std::string::npos);
}

}  // namespace
}  // namespace osteon
