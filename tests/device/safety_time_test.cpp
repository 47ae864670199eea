#include "osteon/device/safety_time.h"

#include <gtest/gtest.h>

namespace osteon {
namespace {

TEST(ForceRamp, RisesInALineAndRestarts) {
  ForceRamp ramp(0.5, 0.02, 0.03);
  EXPECT_EQ(ramp.gain(), 0);
  EXPECT_EQ(ramp.advance(0, 0), 0);
  for (int i = 1; i <= 250; ++i) ramp.advance(0, 0.001);
  EXPECT_NEAR(ramp.gain(), 0.5, 1e-9);
  ramp.restart();
  EXPECT_EQ(ramp.gain(), 0);
}

TEST(ForceRamp, OldDataLowerItToZeroAndOnlyThenAreTooOld) {
  ForceRamp ramp(0.001, 0.02, 0.03);
  ramp.advance(0, 1);
  EXPECT_EQ(ramp.advance(0.020, 0.001), 1);
  EXPECT_NEAR(ramp.advance(0.035, 0.001), 0.5, 1e-12);
  EXPECT_FALSE(ramp.too_old(0.0499));
  EXPECT_TRUE(ramp.too_old(0.0501));
  EXPECT_NEAR(ramp.advance(0.0501, 0.001), 0, 1e-12);
}

TEST(ForceRamp, WithoutTimesItIsASwitch) {
  ForceRamp ramp(0, 0.02, 0);
  EXPECT_EQ(ramp.advance(0.01, 0.001), 1);
  EXPECT_EQ(ramp.advance(0.03, 0.001), 0);
}

TEST(SilenceWatch, CountsOnlyWhileNoNewerReadingComes) {
  SilenceWatch watch;
  watch.see(0, 0.001);
  EXPECT_EQ(watch.silent_s(), 0);  // the first reading is new, whatever its time
  for (int i = 0; i < 7; ++i) watch.see(0, 0.001);
  EXPECT_NEAR(watch.silent_s(), 0.007, 1e-12);
  watch.see(1, 0.001);
  EXPECT_EQ(watch.silent_s(), 0);
  watch.see(-5'000'000, 0.001);  // time that goes back is nothing new
  EXPECT_NEAR(watch.silent_s(), 0.001, 1e-12);
  watch.restart();
  watch.see(-5'000'000, 0.001);
  EXPECT_EQ(watch.silent_s(), 0);
}

TEST(SilenceWatch, OneLongTickOfTheLoopIsNotASilentDevice) {
  SilenceWatch watch;
  watch.see(1, 0.001);
  watch.see(1, 0.5);
  EXPECT_LT(watch.silent_s(), 0.0025);
}

}  // namespace
}  // namespace osteon
