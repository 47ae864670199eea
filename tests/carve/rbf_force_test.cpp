#include "osteon/carve/rbf_force.h"

#include <gtest/gtest.h>

#include <cmath>

namespace osteon {
namespace {

TEST(RbfForce, IsTheFormulaOfEquationsThreeAndFour) {
  const GuidedTunnel tunnel;  // 35 mm, 5 N, 20 vertices
  const double h = 0.035 / 19;
  for (double d = 0; d < 0.036; d += 0.00013) {
    // The printed sum over i = 2 ... 19 of (h - |D - c_i|), by the spacing.
    double sum = 0;
    for (int i = 2; i <= 19; ++i) {
      const double r = std::abs(d - (i - 1) * h);
      if (r < h) sum += (h - r) * 5;
    }
    RbfDrillState fresh;
    EXPECT_NEAR(rbf_drill_force(fresh, tunnel, d), sum / h, 1e-9) << d;
  }
}

TEST(RbfForce, RisesFromZeroStaysAndFallsToZero) {
  const GuidedTunnel tunnel;
  const double h = tunnel.spacing_m();
  RbfDrillState state;
  EXPECT_EQ(rbf_drill_force(state, tunnel, 0), 0);
  EXPECT_NEAR(rbf_drill_force(state, tunnel, 0.5 * h), 2.5, 1e-9);
  for (double d = h; d < 0.035 - h; d += 0.0001)
    EXPECT_NEAR(rbf_drill_force(state, tunnel, d), 5, 1e-9) << d;
  EXPECT_NEAR(rbf_drill_force(state, tunnel, 0.035), 0, 1e-9);
}

TEST(RbfForce, WhatIsDrilledOffStaysSo) {
  const GuidedTunnel tunnel;
  const double h = tunnel.spacing_m();
  RbfDrillState state;
  rbf_drill_force(state, tunnel, 10.01 * h);  // vertices up to c = 9 h are gone
  EXPECT_NEAR(rbf_drill_force(state, tunnel, 9.5 * h), 0.5 * 5, 1e-9);  // that of 10 h alone
  EXPECT_EQ(rbf_drill_force(state, tunnel, 5 * h), 0);
}

TEST(RbfForce, TheNaiveRuleActsOnlyWhileTheDrillGoesDeeper) {
  const GuidedTunnel tunnel;
  NaiveDrillState state;
  EXPECT_EQ(naive_drill_force(state, tunnel, 0), 0);
  EXPECT_EQ(naive_drill_force(state, tunnel, 0.001), 5);
  EXPECT_EQ(naive_drill_force(state, tunnel, 0.001), 0);
  EXPECT_EQ(naive_drill_force(state, tunnel, 0.0009), 0);
  EXPECT_EQ(naive_drill_force(state, tunnel, 0.0011), 5);
  EXPECT_EQ(naive_drill_force(state, tunnel, 0.035), 0);
}

TEST(RbfForce, ATremblingHandFeelsStepsOfTheNaiveRuleAndNoneOfThis) {
  const GuidedTunnel tunnel;
  NaiveDrillState naive;
  RbfDrillState rbf;
  double naive_last = 0, rbf_last = 0, naive_most = 0, rbf_most = 0;
  for (int tick = 0; tick < 3000; ++tick) {
    const double t = tick * 1e-3;
    const double drill = 0.01 * t + 0.05e-3 * std::sin(2 * M_PI * 8 * t);
    const double a = naive_drill_force(naive, tunnel, drill);
    const double b = rbf_drill_force(rbf, tunnel, drill);
    naive_most = std::max(naive_most, std::abs(a - naive_last));
    rbf_most = std::max(rbf_most, std::abs(b - rbf_last));
    naive_last = a;
    rbf_last = b;
  }
  EXPECT_EQ(naive_most, 5);
  EXPECT_LT(rbf_most, 0.1);
}

}  // namespace
}  // namespace osteon
