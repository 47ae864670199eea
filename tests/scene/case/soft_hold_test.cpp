// A band that jaws hold: closed forms of the two legs.
#include "osteon/scene/soft_hold.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "osteon/base/random.h"
#include "osteon/scene/soft_band.h"

namespace osteon {
namespace {

constexpr double kLength_m = 0.03, kStiffness_n = 6000, kStrain = 0.05, kToe = 0.002;
constexpr double kSpring_n_per_m = 2000;

SoftBand held_band() {
  SoftBand band;
  band.to_B = Vec3(kLength_m, 0, 0);
  band.fibres = {{kLength_m / (1 + kStrain), kStiffness_n, kToe}};
  return band;
}
BandSpan straight() { return {Vec3::Zero(), Vec3(kLength_m, 0, 0)}; }

// Beyond the toe: newtons of a leg of so much of the band.
double leg_tension(double length_m, double share) {
  return kStiffness_n * (length_m / share / (kLength_m / (1 + kStrain)) - 1 - kToe);
}

TEST(SoftHold, ABandThatEndsNowhereOrIsHeldNowherePullsNothing) {
  SoftHold hold;
  const Vec3 at(0.015, 0, 0.005);
  for (const double share : {0.0, 1.0, -0.2, std::numeric_limits<double>::quiet_NaN()}) {
    hold.share = share;
    EXPECT_EQ(hold_band(held_band(), straight(), at, hold, kSpring_n_per_m).force_W.norm(), 0);
  }
  hold.share = 0.5;
  EXPECT_EQ(hold_band(held_band(), straight(), at, hold, 0).force_W.norm(), 0);
  const Vec3 nowhere = Vec3::Constant(std::numeric_limits<double>::quiet_NaN());
  EXPECT_EQ(hold_band(held_band(), straight(), nowhere, hold, kSpring_n_per_m).force_W.norm(), 0);
  // Both ends and the jaws in one place.
  const BandSpan none{Vec3::Zero(), Vec3::Zero()};
  EXPECT_TRUE(is_finite(hold_band(held_band(), none, Vec3::Zero(), hold, kSpring_n_per_m).force_W));
}

TEST(SoftHold, WhereItWasTakenItPullsNothing) {
  for (const double share : {0.1, 0.37, 0.5, 0.9}) {
    SoftHold hold;
    hold.share = share;
    const Vec3 at(share * kLength_m, 0, 0);
    const HeldBand held = hold_band(held_band(), straight(), at, hold, kSpring_n_per_m);
    EXPECT_LT(held.force_W.norm(), 1e-9);
    EXPECT_NEAR(held.tension_n, kStiffness_n * (kStrain - kToe), 1e-6);
    EXPECT_NEAR(held.taken_m, 0, 1e-12);
  }
}

// Pulled across in its middle: both legs alike, 2 T b / l is the spring's force k (d - b).
TEST(SoftHold, PulledAcrossItIsTwoLegsAndASpring) {
  for (const double d : {0.001, 0.004, 0.012}) {
    SoftHold hold;
    const HeldBand held =
        hold_band(held_band(), straight(), {kLength_m / 2, 0, d}, hold, kSpring_n_per_m);
    const double b = held.held_W.z(), l = std::hypot(kLength_m / 2, b);
    ASSERT_GT(b, 0);
    EXPECT_NEAR(held.force_W.z(), -2 * leg_tension(l, 0.5) * b / l, 1e-6);
    EXPECT_NEAR(held.force_W.z(), -kSpring_n_per_m * (d - b), 1e-9);
    EXPECT_NEAR(held.force_W.head<2>().norm(), 0, 1e-8);
    EXPECT_NEAR(held.taken_m, 2 * l - kLength_m, 1e-12);
  }
}

// Drawn along: its fibres do not slip in the jaws, so one leg is longer and the other shorter.
TEST(SoftHold, DrawnAlongEachLegHasItsOwnStrain) {
  SoftHold hold;
  hold.share = 1.0 / 3;
  const double share = hold.share, rest = share * kLength_m;
  // (T1 - T2) = K u with K = k (1 / (s L0) + 1 / ((1 - s) L0)) while both are taut.
  const double slack = kLength_m / (1 + kStrain);
  const double legs = kStiffness_n / slack * (1 / share + 1 / (1 - share));
  for (const double d : {-0.0005, 0.0003, 0.02}) {
    const HeldBand held =
        hold_band(held_band(), straight(), {rest + d, 0, 0}, hold, kSpring_n_per_m);
    const double taut = legs * kSpring_n_per_m / (legs + kSpring_n_per_m) * d;
    EXPECT_NEAR(held.force_W.x(), -taut, 1e-6 + 1e-6 * std::abs(taut)) << d;
  }
  // So far that the second leg is slack: the first alone pulls.
  SoftBand loose = held_band();
  loose.fibres[0].slack_m = 0.031;
  const HeldBand held = hold_band(loose, straight(), {rest + 0.02, 0, 0}, hold, kSpring_n_per_m);
  const double l = held.held_W.x();
  EXPECT_NEAR(held.force_W.x(), -kStiffness_n * (l / share / 0.031 - 1 - kToe), 1e-6);
  EXPECT_NEAR(held.force_W.x(), -kSpring_n_per_m * (rest + 0.02 - l), 1e-9);
}

// The force is the slope of an energy, so a way that comes back takes no work, and it is in balance
// wherever the jaws are.
TEST(SoftHold, AroundALoopItDoesNoWork) {
  SoftBand band = held_band();
  band.fibres = {{0.031, 4000, 0.03}, {0.028, 1500, 0.03}};
  band.over_m = 0.004;
  SoftHold hold;
  hold.share = 0.4;
  Random random(3);
  const Vec3 middle(0.4 * 0.034, 0, 0);
  for (int loop = 0; loop < 4; ++loop) {
    const Vec3 u = 0.006 * Vec3(random.uniform(-1, 1), random.uniform(-1, 1), 1);
    const Vec3 v = 0.006 * Vec3(1, random.uniform(-1, 1), random.uniform(-1, 1));
    constexpr int kPoints = 2000;
    double work = 0, size = 0;
    Vec3 before_W = middle + u;
    Vec3 force_before = hold_band(band, straight(), before_W, hold, kSpring_n_per_m).force_W;
    for (int i = 1; i <= kPoints; ++i) {
      const double t = 2 * 3.14159265358979323846 * i / kPoints;
      const Vec3 at = middle + std::cos(t) * u + std::sin(t) * v;
      const Vec3 force = hold_band(band, straight(), at, hold, kSpring_n_per_m).force_W;
      work += 0.5 * (force + force_before).dot(at - before_W);
      size += 0.5 * (force + force_before).norm() * (at - before_W).norm();
      before_W = at;
      force_before = force;
    }
    EXPECT_GT(size, 1e-3);
    EXPECT_LT(std::abs(work), 1e-5 * size);
  }
}

TEST(SoftHold, ASolidIsTwoSpringsOneBehindTheOther) {
  SoftHold hold;
  hold.stiffness_n_per_m = 500;
  const Vec3 force = hold_solid(hold, Vec3::Zero(), Vec3(0, 0.003, 0.004), 2000);
  EXPECT_NEAR((force + 400 * Vec3(0, 0.003, 0.004)).norm(), 0, 1e-12);
  hold.stiffness_n_per_m = 0;
  EXPECT_EQ(hold_solid(hold, Vec3::Zero(), Vec3(0, 0.003, 0.004), 2000), Vec3(0, 0, 0));
}

}  // namespace
}  // namespace osteon
