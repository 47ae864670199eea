// How far a pressed edge goes into a soft solid within a step.
#include "osteon/physics/solid_cutter.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace osteon {
namespace {

constexpr double kPressed_m = 0.001, kNeeds_n = 2, kShare = 0.2;

double goes_in(double push_n, double slid_m, double pressed_m = kPressed_m) {
  return edge_goes_in(pressed_m, push_n, kNeeds_n, slid_m, kShare);
}

TEST(SolidCutter, AnEdgeThatIsNotPressedHardEnoughStaysOutside) {
  EXPECT_EQ(goes_in(5, 0, 0), 0);
  EXPECT_EQ(goes_in(5, 0, -kPressed_m), 0);
  EXPECT_NEAR(goes_in(0.99 * kNeeds_n, 0), 0, 1e-12);
  EXPECT_NEAR(goes_in(0.99 * kShare * kNeeds_n, 1), 0, 1e-12);
}

// Pushed straight in it stands where what is left of the push is the force that it needs.
TEST(SolidCutter, PushedStraightInItStopsWhereThePushIsTheForceThatItNeeds) {
  for (const double push_n : {3.0, 4.0, 20.0})
    EXPECT_NEAR(goes_in(push_n, 0), kPressed_m * (1 - kNeeds_n / push_n), 1e-9) << push_n;
}

// However far it is drawn, it needs the share that friction leaves.
TEST(SolidCutter, DrawnItGoesDeeperDownToAShareOfTheForce) {
  const double push_n = 3;
  double last = goes_in(push_n, 0);
  for (const double slid_m : {0.0002, 0.0005, 0.002}) {
    const double now = goes_in(push_n, slid_m);
    EXPECT_GT(now, last) << slid_m;
    const double turn = slid_m / now;
    const double needs_n = std::max(kShare, 1 / (1 + turn * turn)) * kNeeds_n;
    EXPECT_NEAR(push_n * (1 - now / kPressed_m), needs_n, 1e-9) << slid_m;
    last = now;
  }
  EXPECT_NEAR(goes_in(push_n, 1), kPressed_m * (1 - kShare * kNeeds_n / push_n), 1e-9);
}

}  // namespace
}  // namespace osteon
