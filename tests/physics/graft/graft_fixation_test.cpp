#include "osteon/physics/graft_fixation.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

namespace osteon {
namespace {

constexpr double kDeg = std::numbers::pi / 180;

FixedGraft fixed(const GraftFixing& done) {
  const auto found = fix_graft(done);
  EXPECT_TRUE(found);
  return found.value_or(FixedGraft{});
}

// Pull-outs of 9 x 28 and 10 x 35 mm in a tunnel of 8 mm: 564 and 665 N; the table's stiffness of a
// fixation: 150 N/mm.
TEST(GraftFixation, AGoodOneHoldsAsPublished) {
  const FixedGraft good = fixed({});
  EXPECT_TRUE(good.held);
  EXPECT_NEAR(good.strength_n, 564, 1);
  EXPECT_NEAR(good.stiffness_n_per_m, 150e3, 1);
  EXPECT_LT(good.slack_m, 1e-4);
  EXPECT_NEAR(good.in_socket_m, 0.020, 1e-12);
  GraftFixing longer;
  longer.screw_m = 0.010;
  longer.screw_length_m = 0.035;
  EXPECT_NEAR(fixed(longer).strength_n, 665, 45);
}

TEST(GraftFixation, ADivergentShortOrNarrowScrewHoldsLess) {
  GraftFixing done;
  done.divergence_rad = 30 * kDeg;
  const FixedGraft divergent = fixed(done);
  EXPECT_NEAR(divergent.engaged_m, 0.004 / std::tan(30 * kDeg), 1e-9);
  EXPECT_LT(divergent.strength_n, 200);
  EXPECT_GT(divergent.slack_m, 0.002);
  done.divergence_rad = 5 * kDeg;
  EXPECT_NEAR(fixed(done).engaged_m, 0.028, 1e-9);
  done = {};
  done.screw_m = 0.008;
  EXPECT_NEAR(fixed(done).strength_n, 282, 1);
  done.screw_m = 0.007;
  EXPECT_FALSE(fixed(done).held);
}

TEST(GraftFixation, AShortGraftLeavesLessForTheScrewAndThenNothing) {
  GraftFixing done;
  done.length_m = 0.060;
  EXPECT_NEAR(fixed(done).engaged_m, 0.010, 1e-9);
  done.length_m = 0.045;
  const FixedGraft none = fixed(done);
  EXPECT_FALSE(none.held);
  EXPECT_NE(none.why.find("does not reach"), std::string::npos);
}

TEST(GraftFixation, ALoopThatIsTooShortOrLongerThanTheChannelHoldsNothing) {
  GraftFixing done;
  done.loop_m = 0.015;
  EXPECT_FALSE(fixed(done).held);
  EXPECT_NE(fixed(done).why.find("too short"), std::string::npos);
  done.loop_m = 0.045;
  EXPECT_FALSE(fixed(done).held);
  done.loop_m = 0.030;
  EXPECT_LT(fixed(done).stiffness_n_per_m, fixed({}).stiffness_n_per_m);
}

TEST(GraftFixation, CreepAndAGapAreSlack) {
  GraftFixing done;
  done.pretension_s = done.cycles = 0;
  EXPECT_NEAR(fixed(done).slack_m, 0.03 * (0.020 + 0.030 + 0.040 - 0.028), 1e-6);
  done = {};
  done.button_gap_m = 0.003;
  EXPECT_NEAR(fixed(done).slack_m, 0.003, 1e-4);
}

TEST(GraftFixation, WhatIsNoNumberOrOutOfRangeIsRefused) {
  GraftFixing done;
  done.length_m = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(fix_graft(done));
  done = {};
  done.screw_m = 0.1;
  ASSERT_FALSE(fix_graft(done));
  EXPECT_NE(fix_graft(done).error().message().find("screw's diameter"), std::string::npos);
  done = {};
  done.divergence_rad = -0.1;
  EXPECT_FALSE(fix_graft(done));
}

}  // namespace
}  // namespace osteon
