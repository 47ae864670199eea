#include "osteon/device/passivity.h"

#include <gtest/gtest.h>

#include <cmath>

#include "osteon/base/random.h"

namespace osteon {
namespace {

constexpr double kPassiveDt = 0.001;

// Moves a hand along x by a function of time through an environment force f(x).
template <class Path, class Wall>
PassivityState run(PassivityControl& control, double seconds, Path x_of, Wall force_of) {
  double last = x_of(0.0);
  for (int i = 0; i < static_cast<int>(seconds / kPassiveDt); ++i) {
    const double x = x_of(i * kPassiveDt);
    const Vec3 f = control.control(Vec3(force_of(x), 0, 0), Vec3(x, 0, 0),
                                   Vec3((x - last) / kPassiveDt, 0, 0), kPassiveDt);
    control.delivered(f);
    last = x;
  }
  return control.state();
}

TEST(Passivity, AtRestItChangesNothing) {
  PassivityControl control({});
  for (int i = 0; i < 1000; ++i) {
    const Vec3 f = control.control(Vec3(3, -1, 0.5), Vec3(0.1, 0, 0), Vec3::Zero(), kPassiveDt);
    EXPECT_EQ(f, Vec3(3, -1, 0.5));
    control.delivered(f);
  }
  EXPECT_EQ(control.state().energy_j, 0);
  EXPECT_EQ(control.state().stiffness_share, 1);
}

TEST(Passivity, TheObserverCountsWhatTheHandPutIn) {
  PassivityParams params;
  params.on = false;
  PassivityControl control(params);
  // A spring of 1000 N/m pressed by 4 mm holds 8 mJ; a force held over each tick lags by half a
  // tick's way, so a little less is seen.
  const PassivityState state = run(
      control, 1.0, [](double t) { return -0.004 * std::min(1.0, 2 * t); },
      [](double x) { return -1000 * x; });
  EXPECT_NEAR(state.energy_j, 0.008, 0.0001);
  EXPECT_LT(state.energy_j, 0.008);
}

// A force along the motion feeds the hand: the controller turns it into a brake.
TEST(Passivity, AForceThatFeedsTheHandIsPaidBackAsBoundedDamping) {
  PassivityParams params;
  PassivityControl control(params);
  Vec3 f = Vec3::Zero();
  for (int i = 0; i < 200; ++i) {
    const double x = 0.05 * i * kPassiveDt;
    f = control.control(Vec3(0.2, 0, 0), Vec3(x, 0, 0), Vec3(0.05, 0, 0), kPassiveDt);
    ASSERT_LE(control.state().damping_n_s_per_m, params.max_damping_n_s_per_m);
    control.delivered(f);
  }
  // It gives 0.2 N x 0.05 m/s and takes away as much: the mean force is near zero.
  EXPECT_GT(control.state().energy_j, -0.2 * 0.05 * kPassiveDt * 3);
}

TEST(Passivity, NearRestThereIsNoDampingHoweverMuchIsOwed) {
  PassivityControl control({});
  for (int i = 0; i < 500; ++i) {
    const double x = 0.001 * i * kPassiveDt;  // 1 mm/s
    const Vec3 f = control.control(Vec3(5, 0, 0), Vec3(x, 0, 0), Vec3(0.001, 0, 0), kPassiveDt);
    EXPECT_EQ(f.x(), 5);
    control.delivered(f);
  }
  EXPECT_LT(control.state().energy_j, 0);
}

TEST(Passivity, ADebtFadesInTheAirAndCreditDoesNotLast) {
  PassivityControl control({});
  run(
      control, 0.3, [](double t) { return 0.001 * t; }, [](double) { return 5.0; });
  ASSERT_LT(control.state().energy_j, -1e-4);
  const PassivityState state = run(
      control, 2.0, [](double) { return 0.0003; }, [](double) { return 0.0; });
  EXPECT_GT(state.energy_j, -1e-6);
  EXPECT_LE(state.energy_j, 0);
}

TEST(Passivity, SustainedChatterLowersTheStiffnessAndTheAirRestoresIt) {
  PassivityControl control({});
  const auto swing = [](double t) { return -0.002 + 0.001 * std::sin(120 * t); };
  const PassivityState shaking =
      run(control, 1.0, swing, [](double x) { return -3000 * std::min(0.0, x); });
  EXPECT_LT(shaking.stiffness_share, 0.1);
  EXPECT_GE(shaking.stiffness_share, 0.02);
  EXPECT_GT(shaking.lowered, 5u);
  const PassivityState free = run(
      control, 3.0, [](double) { return 0.01; }, [](double) { return 0.0; });
  EXPECT_EQ(free.stiffness_share, 1);
}

TEST(Passivity, SwitchedOffItOnlyWatches) {
  PassivityParams params;
  params.on = false;
  PassivityControl control(params);
  Random random(4);
  for (int i = 0; i < 2000; ++i) {
    const Vec3 f = 5 * random.direction();
    const Vec3 p = 0.01 * random.direction();
    const Vec3 v = 0.5 * random.direction();
    ASSERT_EQ(control.control(f, p, v, kPassiveDt), f);
    control.delivered(f);
  }
  EXPECT_NE(control.state().energy_j, 0);
}

TEST(Passivity, AJumpOfTheReadingIsNoWork) {
  PassivityControl control({});
  control.control(Vec3(8, 0, 0), Vec3::Zero(), Vec3::Zero(), kPassiveDt);
  control.delivered(Vec3(8, 0, 0));
  control.control(Vec3(8, 0, 0), Vec3(1e300, 0, 0), Vec3::Zero(), kPassiveDt);
  EXPECT_EQ(control.state().energy_j, 0);
}

}  // namespace
}  // namespace osteon
