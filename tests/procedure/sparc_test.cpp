#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "osteon/base/random.h"
#include "osteon/procedure/report.h"

namespace osteon {
namespace {

constexpr double kPi = std::numbers::pi;

// Bell-shaped speed of one clean reach.
std::vector<double> bell(double deviation_s, double rate_hz, double height = 1) {
  std::vector<double> speed;
  const double half_s = 8 * deviation_s;
  for (double t = -half_s; t <= half_s; t += 1 / rate_hz)
    speed.push_back(height * std::exp(-t * t / (2 * deviation_s * deviation_s)));
  return speed;
}

// Length of the curve y(x), x in [0, 1], by many chords.
template <class Curve>
double arc_length(Curve y) {
  constexpr int kChords = 200000;
  double sum = 0;
  for (int i = 0; i < kChords; ++i)
    sum += std::hypot(1.0 / kChords, y(double(i + 1) / kChords) - y(double(i) / kChords));
  return sum;
}

TEST(Sparc, OfNoMovementIsZero) {
  EXPECT_EQ(sparc({}, 100), 0);
  EXPECT_EQ(sparc({1}, 100), 0);
  EXPECT_EQ(sparc(std::vector<double>(500, 0.0), 100), 0);
  EXPECT_EQ(sparc({1, std::numeric_limits<double>::quiet_NaN(), 1}, 100), 0);
  EXPECT_EQ(sparc({1, std::numeric_limits<double>::infinity(), 1}, 100), 0);
}

TEST(Sparc, OfABellHasAClosedForm) {
  // The spectrum of a bell is a bell, exp(-2 pi^2 s^2 f^2), cut where it falls to 0.05: over that
  // band, scaled to 0..1, it is 0.05^(x^2) whatever its width is.
  const double expected = -arc_length([](double x) { return std::pow(0.05, x * x); });
  for (const double deviation_s : {0.08, 0.15, 0.4})
    EXPECT_NEAR(sparc(bell(deviation_s, 100), 100), expected, 5e-3) << deviation_s;
}

TEST(Sparc, OfASteadyDragHasAClosedForm) {
  // Constant speed over 200 samples at 100 Hz: the spectrum is the kernel of Dirichlet, here at the
  // bins of a transform of 256 * 16 points, up to its last value of at least 0.05.
  constexpr int kSamples = 200, kBins = 4096, kCutOff = 409;
  const auto kernel = [](int k) {
    const double x = kPi * k / kBins;
    return k == 0 ? 1.0 : std::abs(std::sin(kSamples * x) / (kSamples * std::sin(x)));
  };
  int last = 0;
  for (int k = 0; k <= kCutOff; ++k)
    if (kernel(k) >= 0.05) last = k;
  double expected = 0;
  for (int k = 1; k <= last; ++k) expected -= std::hypot(1.0 / last, kernel(k) - kernel(k - 1));
  EXPECT_NEAR(sparc(std::vector<double>(kSamples, 0.3), 100), expected, 1e-9);
}

TEST(Sparc, DoesNotDependOnAmplitude) {
  const double once = sparc(bell(0.2, 100), 100);
  EXPECT_NEAR(sparc(bell(0.2, 100, 1e-4), 100), once, 1e-9);
  EXPECT_NEAR(sparc(bell(0.2, 100, 1e4), 100), once, 1e-9);
}

TEST(Sparc, HesitationTakesItFurtherFromZero) {
  // The same reach in one go, and in two, three, four pushes.
  double before = sparc(bell(0.2, 100), 100);
  EXPECT_LT(before, 0);
  for (int pushes = 2; pushes <= 4; ++pushes) {
    std::vector<double> speed;
    for (int i = 0; i < pushes; ++i) {
      const std::vector<double> push = bell(0.2 / pushes, 100);
      speed.insert(speed.end(), push.begin(), push.end());
    }
    const double now = sparc(speed, 100);
    EXPECT_LT(now, before) << pushes;
    before = now;
  }
}

TEST(Sparc, TremorTakesItFurtherFromZero) {
  Random random(3);
  std::vector<double> speed = bell(0.3, 100);
  const double clean = sparc(speed, 100);
  for (std::size_t i = 0; i < speed.size(); ++i)
    speed[i] = std::abs(speed[i] + 0.2 * std::sin(2 * kPi * 8 * double(i) / 100) +
                        random.uniform(-0.05, 0.05));
  EXPECT_LT(sparc(speed, 100), clean - 0.5);
}

TEST(Sparc, MovementAboveTheCutOffDoesNotCount) {
  std::vector<double> speed = bell(0.3, 100);
  const double clean = sparc(speed, 100);
  for (std::size_t i = 0; i < speed.size(); ++i)
    speed[i] *= 1 + 0.3 * std::sin(2 * kPi * 30 * double(i) / 100);
  EXPECT_NEAR(sparc(speed, 100), clean, 1e-2);
}

}  // namespace
}  // namespace osteon
