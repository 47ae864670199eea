// What takes the force away in a run, and that the user alone brings it back. The clock is the
// tests' own.
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <memory>

#include "app/loops/runtime_rig.h"
#include "loops/path_hand.h"
#include "osteon/base/random.h"

namespace osteon {
namespace {

using test::DeviceLog;
using test::FakeDevice;
using test::plan_on;
using test::run_both;
using test::StarvedLoops;

TEST(RuntimeForceOff, AReadingThatIsNotFiniteSwitchesTheForceOffAndSaysWhy) {
  for (const double bad :
       {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    DeviceLog log;
    Runtime runtime(plan_on(test::blocks_case()), std::make_unique<FakeDevice>(
                                                      [bad](std::uint64_t tick) {
                                                        DeviceSample sample =
                                                            test::press_and_slide(tick);
                                                        if (tick == 900) sample.X_VD.p.y() = bad;
                                                        return sample;
                                                      },
                                                      log));
    run_both(runtime, 1000);
    EXPECT_GT(log.forces_V[899].norm(), 0.5);
    for (std::size_t i = 900; i < 1000; ++i) EXPECT_EQ(log.forces_V[i], Vec3::Zero()) << i;
    EXPECT_EQ(runtime.device_status().cause, ForceOff::kNotFinite);
    EXPECT_EQ(runtime.device_status().bad_samples, 1u);
    EXPECT_TRUE(is_finite(runtime.snapshot().tool.X_WP));
  }
}

TEST(RuntimeForceOff, ADeviceThatIsUnpluggedStaysOffUntilTheUserResumes) {
  DeviceLog log;
  Runtime runtime(plan_on(test::blocks_case()), std::make_unique<FakeDevice>(
                                                    [](std::uint64_t tick) {
                                                      DeviceSample sample =
                                                          test::press_and_slide(tick);
                                                      sample.connected = tick < 800 || tick >= 900;
                                                      return sample;
                                                    },
                                                    log));
  run_both(runtime, 1000);
  EXPECT_EQ(runtime.device_status().cause, ForceOff::kDisconnect);
  EXPECT_EQ(log.forces_V[950], Vec3::Zero());
  runtime.set_force_enabled(true);
  run_both(runtime, 1000);
  EXPECT_EQ(runtime.device_status().cause, ForceOff::kNone);
  EXPECT_GT(log.forces_V.back().norm(), 0.5);
}

TEST(RuntimeForceOff, PanicTakesEffectInTheNextTick) {
  DeviceLog log;
  Runtime runtime(plan_on(test::blocks_case()),
                  std::make_unique<FakeDevice>(test::press_and_slide, log));
  run_both(runtime, 900);
  ASSERT_GT(log.forces_V.back().norm(), 0.5);
  runtime.set_force_enabled(false);
  runtime.step_haptic_once();
  EXPECT_EQ(log.forces_V.back(), Vec3::Zero());
}

TEST(RuntimeForceOff, TheForceStaysOffInARunThatStartsWithItOff) {
  DeviceLog log;
  RunPlan plan = plan_on(test::blocks_case());
  plan.force_enabled = false;
  Runtime runtime(plan, std::make_unique<FakeDevice>(test::press_and_slide, log));
  run_both(runtime, 1000);
  for (const Vec3& force : log.forces_V) ASSERT_EQ(force, Vec3::Zero());
}

TEST(RuntimeForceOff, PhysicsThatStopsTakesTheForceAwayAndItStaysAway) {
  DeviceLog log;
  Runtime runtime(plan_on(test::blocks_case()),
                  std::make_unique<FakeDevice>(test::press_and_slide, log));
  run_both(runtime, 900);
  const double pressed = log.forces_V.back().norm();
  ASSERT_GT(pressed, 0.5);
  for (int i = 0; i < 19; ++i) runtime.step_haptic_once();
  EXPECT_NEAR(log.forces_V.back().norm(), pressed, 0.05);
  for (int i = 0; i < 16; ++i) runtime.step_haptic_once();
  EXPECT_LT(log.forces_V.back().norm(), 0.6 * pressed);
  EXPECT_GT(log.forces_V.back().norm(), 0);
  for (int i = 0; i < 20; ++i) runtime.step_haptic_once();
  EXPECT_EQ(log.forces_V.back(), Vec3::Zero());
  run_both(runtime, 100);
  EXPECT_EQ(log.forces_V.back(), Vec3::Zero());
  EXPECT_EQ(runtime.device_status().cause, ForceOff::kWatchdog);
}

TEST(RuntimeForceOff, ADeadManPedalMustBeHeldAndMustBeRepeated) {
  DeviceLog log;
  Runtime runtime(plan_on(test::blocks_case()),
                  std::make_unique<FakeDevice>(test::press_and_slide, log));
  HandWishes held;
  held.has_dead_man = held.dead_man_held = true;
  const auto run_telling = [&](int ticks) {
    for (int i = 0; i < ticks; i += 10) {
      runtime.set_hand_wishes(held);
      run_both(runtime, 10);
    }
  };
  run_telling(900);
  EXPECT_GT(log.forces_V.back().norm(), 0.5);
  run_both(runtime, 240);  // a slow picture is no letting go
  EXPECT_GT(log.forces_V.back().norm(), 0.5);
  run_both(runtime, 20);  // a window that hangs is
  EXPECT_EQ(log.forces_V.back(), Vec3::Zero());
  EXPECT_EQ(runtime.device_status().cause, ForceOff::kDeadMan);
  run_telling(100);
  EXPECT_EQ(log.forces_V.back(), Vec3::Zero()) << "re-armed by itself";
  runtime.set_force_enabled(true);
  run_telling(900);
  EXPECT_GT(log.forces_V.back().norm(), 0.5);
  held.dead_man_held = false;
  runtime.set_hand_wishes(held);
  runtime.step_haptic_once();
  EXPECT_EQ(log.forces_V.back(), Vec3::Zero());
}

// The demonstration: an emulated hand that presses onto the block.
StarvedLoops demonstration() {
  DeviceInfo info;
  info.peak_force_n = info.continuous_force_n = 8;
  return StarvedLoops(std::make_unique<PathHand>(test::pressing_path(), info));
}

TEST(RuntimeForceOff, AStarvedDemonstrationStopsSaysWhyAndGoesOnWhenTheUserWishes) {
  StarvedLoops demo = demonstration();
  demo.run(900);
  const double pressed_n = demo.force_n();
  ASSERT_GT(pressed_n, 0.5);
  demo.run(60, false);  // physics gets no time
  EXPECT_EQ(demo.force_n(), 0);
  EXPECT_EQ(demo.cause(), ForceOff::kWatchdog);
  demo.enable();  // of no use while it lasts
  for (int i = 0; i < 40; ++i) {
    demo.run(1, false);
    ASSERT_EQ(demo.force_n(), 0) << i;
  }
  EXPECT_EQ(demo.cause(), ForceOff::kWatchdog);

  demo.run(500);  // the computer has time again: nothing comes back by itself
  EXPECT_EQ(demo.force_n(), 0);
  EXPECT_EQ(demo.cause(), ForceOff::kWatchdog);
  demo.enable();
  demo.run(10);
  EXPECT_GT(demo.force_n(), 0);
  EXPECT_LT(demo.force_n(), 0.2) << "no ramp";
  demo.run(900);
  EXPECT_NEAR(demo.force_n(), pressed_n, 0.05);
  EXPECT_EQ(demo.cause(), ForceOff::kNone);
}

TEST(RuntimeForceOff, ATickThatComesLateGivesNoForceAndRampsInAgainWithoutAFault) {
  StarvedLoops demo = demonstration();
  demo.run(900);
  const double pressed_n = demo.force_n();
  demo.tick(0.019, true);
  EXPECT_NEAR(demo.force_n(), pressed_n, 0.05) << "19 ms are borne";
  demo.tick(0.1, true);
  EXPECT_EQ(demo.force_n(), 0);
  demo.run(10);
  EXPECT_LT(demo.force_n(), 0.2);
  demo.run(900);
  EXPECT_NEAR(demo.force_n(), pressed_n, 0.05);
  EXPECT_EQ(demo.cause(), ForceOff::kNone);
}

// Ticks from 1 to 150 ms apart, physics when it happens to be given time, and a user who resumes
// now and then.
TEST(RuntimeForceOff, HoweverTheLoopsAreStarvedNoForceIsPastItsLimitsAndNoneComesWithATrip) {
  StarvedLoops demo = demonstration();
  Random random(7);
  int trips = 0;
  bool was_on = false;
  double risen_s = 0;  // since the ramp last had a reason to begin anew
  for (int i = 0; i < 20000; ++i) {
    const bool busy = i / 500 % 2 == 1;
    const double dt_s = busy && random.uniform() < 0.05 ? random.uniform(0.002, 0.15) : 0.001;
    if (random.uniform() < 0.002) {
      demo.enable();
      risen_s = 0;
    }
    risen_s = dt_s > SafetyParams{}.stall_s ? 0 : risen_s + dt_s;
    demo.tick(dt_s, random.uniform() < (busy ? 0.02 : 0.5));
    const double share = std::min(1.0, risen_s / SafetyParams{}.ramp_in_s);
    ASSERT_LE(demo.force_n(), 8 * share + 1e-9) << i;
    const bool on = demo.force_n() > 0;
    trips += was_on && !on ? 1 : 0;
    was_on = on;
  }
  EXPECT_GT(trips, 20);
}

}  // namespace
}  // namespace osteon
