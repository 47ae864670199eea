// A tip that breaks through skin: the force rises, peaks and falls to friction.
#include "osteon/tissue/sheet_pierce.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace osteon {
namespace {

constexpr double kStep = 0.001, kTrocar = 0.0025;

TEST(SheetPierce, ATrocarBreaksInAtTheTablesForceAndANeedleAtMuchLess) {
  const SheetMaterial m;
  EXPECT_NEAR(pierce_law(m, kTrocar, 0, 400).peak_n, 25, 0.1);
  EXPECT_NEAR(pierce_law(m, 0.00064, 0, 400).peak_n, 1.6, 0.1);  // 18 G
}

// The rim is stretched from its radius under tension alone to the shaft's.
TEST(SheetPierce, TheRimGripsTheShaftByItsStretch) {
  const SheetMaterial m;
  const PierceLaw law = pierce_law(m, kTrocar, 0, 400);
  EXPECT_NEAR(law.hole_m, 0.002, 1e-12);
  // (r - a) / a = 2 T / Eh + (1 + nu) q / Eh
  const double q = (0.25 - 0.16) * 1000 / 1.45;
  EXPECT_NEAR(law.grip_n, 0.3 * 2 * std::numbers::pi * kTrocar * q, 1e-9);
}

TEST(SheetPierce, ASlitThatIsLongEnoughLetsItInAndAShortOneHelps) {
  const SheetMaterial m;
  const double around = std::numbers::pi * kTrocar;
  EXPECT_EQ(pierce_law(m, kTrocar, around, 400).peak_n, 0);
  EXPECT_EQ(pierce_law(m, kTrocar, around, 400).grip_n, 0);
  const double half = pierce_law(m, kTrocar, 0.4 * around, 400).peak_n;
  EXPECT_NEAR(half, 12.5, 0.1);
}

TEST(SheetPierce, TheForceRisesPeaksAndFalls) {
  const PierceLaw law = pierce_law({}, kTrocar, 0, 400);
  PierceState state;
  const auto elastic = [](double depth) { return 3000 * depth; };
  double last = 0;
  int i = 0;
  for (; !state.through; ++i) {
    const double depth = 2e-5 * i;
    const bool breaks = pierce_step(state, law, depth, elastic(depth), kStep);
    EXPECT_EQ(breaks, state.through);
    EXPECT_EQ(state.force_n, elastic(depth));
    ASSERT_LT(i, 1000);
  }
  EXPECT_NEAR(state.force_n, law.peak_n, 0.1);
  last = state.force_n;
  for (int k = 0; k < 200; ++k, ++i) {
    EXPECT_FALSE(pierce_step(state, law, 2e-5 * i, elastic(2e-5 * i), kStep));
    EXPECT_LE(state.force_n, last + 1e-12);
    EXPECT_LT(last - state.force_n, 0.07 * law.peak_n);  // falls, without a step
    last = state.force_n;
  }
  EXPECT_NEAR(state.force_n, law.grip_n + law.resist_n, 0.01);
  // Out: first the rim goes along, then it holds back with its grip, then nothing.
  for (int k = 0; k < 400; ++k) pierce_step(state, law, 2e-5 * --i, 99, kStep);
  EXPECT_NEAR(state.force_n, -law.grip_n, 1e-9);
  pierce_step(state, law, -0.001, 0, kStep);
  EXPECT_EQ(state.force_n, 0);
  // The hole stays.
  pierce_step(state, law, 0.0001, 0.3, kStep);
  EXPECT_TRUE(state.through);
  EXPECT_LE(state.force_n, law.grip_n + law.resist_n);
}

TEST(SheetPierce, PressedLessThanThePeakItSpringsBack) {
  const PierceLaw law = pierce_law({}, kTrocar, 0, 400);
  PierceState state;
  EXPECT_FALSE(pierce_step(state, law, 0.004, 12, kStep));
  EXPECT_EQ(state.force_n, 12);
  EXPECT_FALSE(pierce_step(state, law, -0.001, 0, kStep));
  EXPECT_EQ(state.force_n, 0);
  EXPECT_FALSE(state.through);
}

}  // namespace
}  // namespace osteon
