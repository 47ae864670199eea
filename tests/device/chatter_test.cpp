#include "osteon/device/chatter.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace osteon {
namespace {

constexpr double kDt = 0.001;
const ChatterParams kParams;

// Largest growth that a swing of this frequency and amplitude shows; `decay` per second.
double growth_of(double hz, double amplitude_m, double decay_per_s, double force_n) {
  SwingWatch watch;
  double largest = 0;
  for (int i = 0; i < 2000; ++i) {
    const double t = i * kDt;
    const double x =
        amplitude_m * std::exp(-decay_per_s * t) * std::sin(2 * std::numbers::pi * hz * t);
    largest = std::max(largest, watch.see(x, force_n, kDt, kParams));
  }
  return largest;
}

TEST(SwingWatch, AStillHandAndASensorsNoiseAreNone) {
  EXPECT_EQ(growth_of(0, 0, 0, 5), 0);
  EXPECT_EQ(growth_of(200, 0.00005, 0, 5), 0);
}

TEST(SwingWatch, SwingsThatStayOrGrowAreFound) {
  EXPECT_NEAR(growth_of(20, 0.002, 0, 5), 1, 0.05);
  EXPECT_GT(growth_of(20, 0.0005, -2, 5), 1.03);
}

TEST(SwingWatch, SwingsThatDieDownAreSlowOrAreInTheAirAreNone) {
  EXPECT_EQ(growth_of(20, 0.002, 8, 5), 0);
  EXPECT_EQ(growth_of(3, 0.010, 0, 5), 0);
  EXPECT_EQ(growth_of(20, 0.002, 0, 0), 0);
}

// One contact of `contact_s` that comes in at `in` and leaves at `out`, m/s along y.
double bounce(double in, double out, double contact_s) {
  BounceWatch watch;
  double found = watch.see(Vec3(0, -in, 0), Vec3::Zero(), kDt, kParams);
  const int ticks = static_cast<int>(contact_s / kDt);
  for (int i = 0; i <= ticks; ++i) {
    const double v = -in + (in + out) * i / ticks;
    found = std::max(found, watch.see(Vec3(0.3, v, 0), Vec3(0, 2, 0), kDt, kParams));
  }
  return std::max(found, watch.see(Vec3(0.3, out, 0), Vec3::Zero(), kDt, kParams));
}

TEST(BounceWatch, FindsWallsThatGiveBackMoreThanTheyTook) {
  EXPECT_NEAR(bounce(0.1, 0.12, 0.02), 1.2, 1e-9);
  EXPECT_EQ(bounce(0.1, 0.06, 0.02), 0);   // it took some
  EXPECT_EQ(bounce(0.01, 0.02, 0.02), 0);  // too slow to matter
  EXPECT_EQ(bounce(0.1, 0.12, 0.2), 0);    // time enough for the user to pull away
}

}  // namespace
}  // namespace osteon
