#include "osteon/device/virtual_hand.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "osteon/base/random.h"

namespace osteon {
namespace {

constexpr double kHandDt = 0.001;

// Position of m x'' = k (x_w - x) - b x' from rest at 0 with x_w = 1, at time t.
double step_response(const HandParams& p, double t) {
  const double w0 = std::sqrt(p.grip_stiffness_n_per_m / p.mass_kg);
  const double z = p.grip_damping_n_s_per_m / (2 * std::sqrt(p.grip_stiffness_n_per_m * p.mass_kg));
  if (z < 1) {
    const double wd = w0 * std::sqrt(1 - z * z);
    return 1 - std::exp(-z * w0 * t) * (std::cos(wd * t) + z * w0 / wd * std::sin(wd * t));
  }
  const double r = std::sqrt(z * z - 1);
  const double s1 = -w0 * (z - r);
  const double s2 = -w0 * (z + r);
  return 1 + (s2 * std::exp(s1 * t) - s1 * std::exp(s2 * t)) / (s1 - s2);
}

double worst_error(const HandParams& p, double dt) {
  VirtualHand hand(p);
  Pose wanted;
  wanted.p = Vec3(1, 0, 0);
  double worst = 0;
  for (int i = 1; i * dt <= 1.0; ++i) {
    hand.step(dt, wanted, Vec3::Zero(), Vec3::Zero());
    worst = std::max(worst, std::abs(hand.pose().p.x() - step_response(p, i * dt)));
  }
  return worst;
}

TEST(VirtualHand, StepResponseConvergesToTheClosedForm) {
  for (const HandParams& p :
       {HandParams{0.5, 1500, 2}, HandParams{0.15, 500, 12}, HandParams{0.05, 50, 30}}) {
    const double coarse = worst_error(p, 1e-3);
    const double fine = worst_error(p, 1e-4);
    EXPECT_LT(coarse, 0.06) << p.mass_kg;
    // First order: a tenth of the step leaves about a tenth of the error.
    EXPECT_LT(fine, 0.15 * coarse) << p.mass_kg;
  }
}

TEST(VirtualHand, ConstantForceStretchesTheGripByForceOverStiffness) {
  const HandParams p{0.15, 500, 12};
  VirtualHand hand(p);
  const Vec3 force(1, -2, 3);
  for (int i = 0; i < 3000; ++i) hand.step(kHandDt, Pose{}, Vec3::Zero(), force);
  EXPECT_LT((hand.pose().p - force / p.grip_stiffness_n_per_m).norm(), 1e-9);
  EXPECT_LT(hand.velocity().norm(), 1e-9);
}

TEST(VirtualHand, FollowsAMovingTargetWithinOneStep) {
  VirtualHand hand;
  const Vec3 v(0.05, 0, -0.02);
  Pose wanted;
  for (int i = 0; i < 3000; ++i) {
    wanted.p += kHandDt * v;
    hand.step(kHandDt, wanted, v, Vec3::Zero());
  }
  // The grip pulls from where the hand was: one step of lead, no lag.
  EXPECT_LT((hand.pose().p - wanted.p - kHandDt * v).norm(), 1e-9);
  EXPECT_LT((hand.velocity() - v).norm(), 1e-9);
}

TEST(VirtualHand, EnergyNeverGrowsWithoutForceForEveryHandInRange) {
  Random random(7);
  for (int k = 0; k < 200; ++k) {
    HandParams p;
    p.mass_kg = random.uniform(0.05, 0.5);
    p.grip_stiffness_n_per_m = random.uniform(50, 1500);
    p.grip_damping_n_s_per_m = random.uniform(2, 30);
    VirtualHand hand(p);
    Pose wanted;
    wanted.p = Vec3(0.01, 0, 0);
    const double start = hand.energy(wanted);
    // Semi-implicit Euler holds an energy that differs from the true one by O(dt k / b) at most.
    for (int i = 0; i < 500; ++i) {
      hand.step(kHandDt, wanted, Vec3::Zero(), Vec3::Zero());
      ASSERT_LT(hand.energy(wanted), 1.05 * start);
    }
    EXPECT_LT(hand.energy(wanted), 0.9 * start);
  }
}

TEST(VirtualHand, AngularVelocityIsThatOfTheWantedRotation) {
  VirtualHand hand;
  const Vec3 axis = Vec3(1, 2, -2) / 3.0;
  const double rate = 3.0;
  Pose wanted;
  for (int i = 1; i <= 2000; ++i) {
    wanted.q = Quat(Eigen::AngleAxisd(rate * kHandDt * i, axis));
    if (i % 2) wanted.q.coeffs() *= -1;  // the same rotation
    hand.step(kHandDt, wanted, Vec3::Zero(), Vec3::Zero());
    ASSERT_LT((hand.angular_velocity() - rate * axis).norm(), 1e-9);
  }
  hand.step(kHandDt, wanted, Vec3::Zero(), Vec3::Zero());
  EXPECT_LT(hand.angular_velocity().norm(), 1e-12);
}

TEST(VirtualHand, RefusesWhatIsNotFinite) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  VirtualHand hand;
  VirtualHand calm;
  hand.step(kHandDt, Pose{}, Vec3::Zero(), Vec3(nan, 0, 0));
  calm.step(kHandDt, Pose{}, Vec3::Zero(), Vec3::Zero());
  EXPECT_EQ(hand.pose().p, calm.pose().p);
  Pose bad;
  bad.p.x() = std::numeric_limits<double>::infinity();
  hand.step(kHandDt, bad, Vec3::Zero(), Vec3(1, 0, 0));
  hand.step(nan, Pose{}, Vec3::Zero(), Vec3(1, 0, 0));
  hand.step(-kHandDt, Pose{}, Vec3::Zero(), Vec3(1, 0, 0));
  EXPECT_EQ(hand.pose().p, calm.pose().p);
}

}  // namespace
}  // namespace osteon
