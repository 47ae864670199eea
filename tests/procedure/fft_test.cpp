#include "fft.h"

#include <gtest/gtest.h>

#include <numbers>

#include "osteon/base/random.h"

namespace osteon {
namespace {

using Complex = std::complex<double>;

// The definition, term by term.
std::vector<Complex> slow_transform(const std::vector<Complex>& x) {
  std::vector<Complex> result(x.size());
  for (std::size_t k = 0; k < x.size(); ++k)
    for (std::size_t n = 0; n < x.size(); ++n)
      result[k] += x[n] * std::polar(1.0, -2 * std::numbers::pi * double(k * n % x.size()) /
                                              double(x.size()));
  return result;
}

TEST(Fft, OfOneSampleIsTheSample) {
  std::vector<Complex> x{{3, -2}};
  fft(x);
  EXPECT_EQ(x[0], Complex(3, -2));
}

TEST(Fft, AgreesWithTheDefinition) {
  Random random(5);
  for (const std::size_t size : {2, 4, 8, 64, 512}) {
    std::vector<Complex> x(size);
    for (Complex& value : x) {
      const double re = random.uniform(-1, 1);
      const double im = random.uniform(-1, 1);
      value = {re, im};
    }
    const std::vector<Complex> expected = slow_transform(x);
    fft(x);
    for (std::size_t k = 0; k < size; ++k) EXPECT_LT(std::abs(x[k] - expected[k]), 1e-11);
  }
}

}  // namespace
}  // namespace osteon
