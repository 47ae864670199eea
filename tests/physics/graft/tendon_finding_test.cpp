// Fascia is opened by what presses on it and is drawn, and tendons are lifted out where it is open.
#include "graft/tendon_finding.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "graft_bench_case.h"

namespace osteon {
namespace {

using testing::bench_case;

class TendonFinding : public ::testing::Test {
 protected:
  GraftBenchPlan plan = *find_graft_bench(*bench_case(testing::covered_bench_def()));
  GraftBenchState state = fresh_bench(plan);
  BenchHand hand;
  ToolState tool;

  void blade_at(double x, double y, double force_n) {
    tool.X_WP.p = Vec3(x, y, 0);
    tool.contact_count = 1;
    tool.force_W = Vec3(0, 0, force_n);
    open_fascia(plan, tool, state, hand);
  }
  void draw(double from_x, double to_x, double y, double force_n) {
    hand = {};
    const int steps = static_cast<int>(std::abs(to_x - from_x) / 0.0005);
    for (int n = 0; n <= steps; ++n) blade_at(from_x + (to_x - from_x) * n / steps, y, force_n);
  }
  void shut_at(const Vec3& p_W) {
    hand = {};
    tool.X_WP.p = p_W;
    take_tendon(plan, tool, state, hand);
  }
  // Pulled up for a while.
  void lift(double force_n, double seconds) {
    tool.force_W = Vec3(0, 0, -force_n);
    for (int n = 0; n < static_cast<int>(seconds / 0.002); ++n)
      lift_tendon(plan, tool, 0.002, state, hand);
  }
};

TEST_F(TendonFinding, ABladeThatIsDrawnAlongTheMarkOpensIt) {
  draw(0.010, 0.040, 0.001, 0.5);
  EXPECT_NEAR(fascia_open_m(plan, state), 0.030, 0.0011);
  EXPECT_EQ(state.hurt, 0u);
  draw(0.042, 0.039, 0, 0.5);  // strokes add up, either way
  EXPECT_NEAR(fascia_open_m(plan, state), 0.032, 0.0011);
}

TEST_F(TendonFinding, AFastStrokeLeavesNoBridges) {
  hand = {};
  for (const double x : {0.010, 0.016, 0.023, 0.035}) blade_at(x, 0, 0.5);
  EXPECT_NEAR(fascia_open_m(plan, state), 0.026, 1e-9);
}

TEST_F(TendonFinding, WhatDoesNotPressOrLiesBesideOpensNothing) {
  draw(0.010, 0.040, 0, 0.1);
  draw(0.010, 0.040, 0.006, 0.5);
  draw(0.050, 0.070, 0, 0.5);
  hand = {};
  tool.X_WP.p = Vec3(0.02, 0, 0.02);  // in the air
  tool.contact_count = 0;
  open_fascia(plan, tool, state, hand);
  tool.contact_count = 1;
  tool.X_WP.p = Vec3(0.02, 0, 0);
  tool.force_W.setConstant(std::numeric_limits<double>::quiet_NaN());
  open_fascia(plan, tool, state, hand);
  EXPECT_EQ(state.slit, 0u);
  EXPECT_EQ(state.hurt, 0u);
  plan = *find_graft_bench(*bench_case());  // without fascia
  draw(0.010, 0.040, 0, 9);
  EXPECT_EQ(state.hurt, 0u);
}

TEST_F(TendonFinding, WhatLiesUnderAndBehindIsHurtByForceAndByABladeThatIsDrawn) {
  draw(0.010, 0.040, 0, 4.9);
  EXPECT_EQ(state.hurt, 0u);
  draw(0.010, 0.012, 0, 5.1);
  EXPECT_EQ(state.hurt, kMclHurt);
  hand = {};
  for (int n = 0; n < 100; ++n) blade_at(0.02, -0.022, 0.5);  // it rests there
  EXPECT_EQ(state.hurt, kMclHurt);
  draw(0.010, 0.020, 0.022, 0.5);  // before the semitendinosus there is none
  EXPECT_EQ(state.hurt, kMclHurt);
  draw(0.010, 0.020, -0.022, 0.5);
  EXPECT_EQ(state.hurt, kMclHurt | kNerveHurt);
}

TEST_F(TendonFinding, JawsTakeATendonWhereTheFasciaIsOpen) {
  shut_at(found_at_W(plan, 1));
  EXPECT_EQ(hand.lifts, 0u) << "it is whole";
  draw(0.010, 0.030, 0, 0.5);
  shut_at(Vec3(0.035, -0.012, 0));
  EXPECT_EQ(hand.lifts, 0u) << "whole there";
  shut_at(Vec3(0.024, 0, 0));
  EXPECT_EQ(hand.lifts, 0u) << "between both";
  shut_at(Vec3(0.024, -0.012, 0.02));
  EXPECT_EQ(hand.lifts, 0u) << "in the air";
  shut_at(found_at_W(plan, 1));
  EXPECT_EQ(hand.lifts, 2u);
  state.tendons[0].stripped = true;
  shut_at(found_at_W(plan, 0));
  EXPECT_EQ(hand.lifts, 0u) << "it is out";
}

TEST_F(TendonFinding, ATendonFollowsThePullAndIsFoundOnceItIsOut) {
  state.slit = kFasciaOpen;
  shut_at(found_at_W(plan, 0));
  lift(1.2, 2);
  EXPECT_NEAR(hand.front_m, 1.2 / kLift_n_per_m, 1e-6);
  EXPECT_FALSE(state.tendons[0].found);
  const ToolGuide guide = guide_of_lift(plan, hand, 0, Pose{});
  EXPECT_TRUE(guide.on && guide.pulls);
  EXPECT_EQ(guide.stop_m, hand.front_m);
  EXPECT_EQ(guide.grip, 1);
  EXPECT_LT((guide.nhat_B - Vec3::UnitZ()).norm(), 1e-12);
  lift(-3, 2);  // let down
  EXPECT_EQ(hand.front_m, 0);
  lift(1.8, 2);
  EXPECT_TRUE(state.tendons[0].found);
  EXPECT_FALSE(state.tendons[1].found);
}

}  // namespace
}  // namespace osteon
