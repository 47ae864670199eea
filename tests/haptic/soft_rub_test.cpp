// Stick and slip on a soft part, against the closed form: a spring until it slips, then a constant.
#include "osteon/haptic/soft_rub.h"

#include <gtest/gtest.h>

#include <cmath>

namespace osteon {
namespace {

constexpr double kPush_n = 2, kResting = 0.08, kSliding = 0.05, kSpring_n_per_m = 2000;

RubNow pressed(const Vec3& way) {
  RubNow now;
  now.push_W = {0, 0, kPush_n};
  now.resting_n = kResting * kPush_n;
  now.sliding_n = kSliding * kPush_n;
  now.way_W = way;
  now.stiffness_n_per_m = kSpring_n_per_m;
  return now;
}

// 10 mm/s along x: F = -k x up to the resting ratio, and the sliding one after that.
TEST(SoftRub, HoldsLikeASpringAndThenSlidesByTheSlidingRatio) {
  constexpr double kWay_m = 1e-5;
  SoftRub state;
  double last = 0, peak = 0, step = 0;
  for (int n = 1; n <= 400; ++n) {
    const Vec3 force = rub(pressed({kWay_m, 0, 0}), state);
    EXPECT_EQ(force.tail<2>(), Eigen::Vector2d(0, 0));
    if (n * kWay_m * kSpring_n_per_m < 0.999 * kResting * kPush_n) {
      ASSERT_NEAR(force.x(), -kSpring_n_per_m * n * kWay_m, 1e-9) << n;
      ASSERT_FALSE(state.sliding);
    }
    step = std::max(step, std::abs(force.x() - last));
    peak = std::max(peak, -force.x());
    last = force.x();
  }
  EXPECT_NEAR(peak, kResting * kPush_n, 0.02 * peak);
  EXPECT_TRUE(state.sliding);
  EXPECT_NEAR(last, -kSliding * kPush_n, 1e-12);
  EXPECT_LT(step, 0.02 * kPush_n);
}

// Back: it holds at once, through zero, and slips the other way by the same law.
TEST(SoftRub, GoingBackItHoldsAndSlipsTheOtherWay) {
  SoftRub state;
  for (int n = 0; n < 400; ++n) (void)rub(pressed({1e-5, 0, 0}), state);
  const Vec3 first = rub(pressed({-1e-6, 0, 0}), state);
  EXPECT_FALSE(state.sliding);
  EXPECT_NEAR(first.x(), -kSliding * kPush_n + 1e-6 * kSpring_n_per_m, 1e-9);
  for (int n = 0; n < 400; ++n) (void)rub(pressed({-1e-5, 0, 0}), state);
  EXPECT_TRUE(state.sliding);
  EXPECT_NEAR(rub(pressed({-1e-5, 0, 0}), state).x(), kSliding * kPush_n, 1e-12);
}

TEST(SoftRub, ALighterPushHoldsLess) {
  SoftRub state;
  for (int n = 0; n < 7; ++n) (void)rub(pressed({1e-5, 0, 0}), state);
  RubNow lighter = pressed(Vec3::Zero());
  lighter.push_W *= 0.5;
  lighter.resting_n *= 0.5;
  lighter.sliding_n *= 0.5;
  EXPECT_NEAR(rub(lighter, state).norm(), 0.5 * kResting * kPush_n, 1e-12);
}

TEST(SoftRub, TheDamperNeverHoldsMoreThanFrictionDoes) {
  SoftRub state;
  RubNow fast = pressed({1e-5, 0, 0});
  fast.damping_n_s_per_m = 100;
  EXPECT_NEAR(rub(fast, state).x(), -kResting * kPush_n, 1e-12);
}

TEST(SoftRub, NothingPressedOrNotANumberHoldsNothing) {
  SoftRub state;
  for (int n = 0; n < 5; ++n) (void)rub(pressed({1e-5, 0, 0}), state);
  EXPECT_EQ(rub(pressed({std::nan(""), 0, 0}), state), Vec3(0, 0, 0));
  EXPECT_EQ(state.lag_W, Vec3(0, 0, 0));
  RubNow free = pressed({1e-5, 0, 0});
  free.push_W.setZero();
  EXPECT_EQ(rub(free, state), Vec3(0, 0, 0));
  EXPECT_FALSE(state.sliding);
}

}  // namespace
}  // namespace osteon
