#include "spring.h"

#include <gtest/gtest.h>

#include <cmath>

#include "osteon/base/random.h"

namespace osteon {
namespace {

double energy(double m, double k, double x, double v) { return 0.5 * (m * v * v + k * x * x); }

TEST(SpringVelocity, WithoutSpringIsNewton) {
  EXPECT_DOUBLE_EQ(spring_velocity(2, 0, 0, 0.1, 5, 3, 4), 3.2);
}

TEST(SpringVelocity, SolvesBackwardEuler) {
  Random random(1);
  for (int i = 0; i < 100; ++i) {
    const double m = random.uniform(1e-4, 1), k = random.uniform(0, 1e4);
    const double c = random.uniform(0, 100), dt = random.uniform(1e-4, 0.1);
    const double x = random.uniform(-1, 1), v = random.uniform(-1, 1), f = random.uniform(-9, 9);
    const double v1 = spring_velocity(m, k, c, dt, x, v, f);
    const double residual = m * (v1 - v) / dt - (f - k * (x + dt * v1) - c * v1);
    EXPECT_NEAR(residual, 0, 1e-8 * (1 + k));
  }
}

TEST(SpringVelocity, NeverGainsEnergy) {
  Random random(2);
  for (int i = 0; i < 200; ++i) {
    const double m = std::pow(10, random.uniform(-7, 1)), k = std::pow(10, random.uniform(-2, 7));
    const double c = i % 2 == 0 ? 0 : std::pow(10, random.uniform(-4, 3));
    const double dt = std::pow(10, random.uniform(-5, 0));
    double x = random.uniform(-1, 1), v = random.uniform(-10, 10);
    for (int step = 0; step < 100; ++step) {
      const double before = energy(m, k, x, v);
      v = spring_velocity(m, k, c, dt, x, v, 0);
      x += dt * v;
      EXPECT_LE(energy(m, k, x, v), before * (1 + 1e-12));
    }
  }
}

TEST(SpringVelocity, ApproachesTheCriticallyDampedSolution) {
  // x(t) = (1 + w t) exp(-w t) for x(0) = 1, v(0) = 0 and critical damping.
  const double m = 0.01, k = 100, w = std::sqrt(k / m), dt = 1e-6;
  const double c = damping_constant(m, k, 1);
  double x = 1, v = 0;
  for (int i = 0; i < 20000; ++i) {
    v = spring_velocity(m, k, c, dt, x, v, 0);
    x += dt * v;
  }
  const double t = 0.02;
  EXPECT_NEAR(x, (1 + w * t) * std::exp(-w * t), 1e-4);
}

TEST(TurnBetween, IsTwiceTheSineOfHalfTheAngle) {
  Random random(3);
  for (int i = 0; i < 100; ++i) {
    const Quat rest = random.rotation();
    const Vec3 axis = random.direction();
    const double angle = random.uniform(0, 3.1);
    const Quat turn(Eigen::AngleAxisd(angle, axis));
    const Vec3 expected = 2 * std::sin(angle / 2) * axis;
    EXPECT_LT((turn_between(rest, rest * turn) - expected).norm(), 1e-12);
    Quat other = rest * turn;
    other.coeffs() *= -1.0;
    EXPECT_LT((turn_between(rest, other) - expected).norm(), 1e-12);
  }
}

TEST(LimitTurn, LeavesSmallTurnsAlone) {
  Random random(4);
  const Quat rest = random.rotation();
  const Quat q = rest * Quat(Eigen::AngleAxisd(0.3, random.direction()));
  bool limited = true;
  EXPECT_EQ(limit_turn(rest, q, 0.5, &limited).coeffs(), q.coeffs());
  EXPECT_FALSE(limited);
}

TEST(LimitTurn, KeepsTheAxis) {
  Random random(5);
  for (int i = 0; i < 100; ++i) {
    const Quat rest = random.rotation();
    const Vec3 axis = random.direction();
    const double angle = random.uniform(0.6, 3.1);
    const Quat q = rest * Quat(Eigen::AngleAxisd(angle, axis));
    bool limited = false;
    const Quat cut = limit_turn(rest, q, 0.5, &limited);
    EXPECT_TRUE(limited);
    EXPECT_LT((turn_between(rest, cut) - 0.5 * axis).norm(), 1e-12);
    EXPECT_NEAR(cut.norm(), 1, 1e-14);
  }
}

}  // namespace
}  // namespace osteon
