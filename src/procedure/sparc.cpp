#include <algorithm>
#include <bit>
#include <cmath>
#include <complex>
#include <numbers>
#include <vector>

#include "fft.h"
#include "osteon/procedure/report.h"

namespace osteon {
namespace {

constexpr double kCutOffHz = 10;
constexpr double kThreshold = 0.05;
constexpr int kPaddingLevel = 4;
constexpr std::size_t kMaxSize = std::size_t{1} << 22;

std::size_t padded_size(std::size_t samples) {
  const std::size_t least = std::bit_ceil(samples);
  return std::max(least, std::min(least << kPaddingLevel, kMaxSize));
}

// Bins first, first + parts, first + 2 parts, ... of the spectrum of `speed` padded with zeros to
// size * parts samples.
std::vector<std::complex<double>> every_nth_bin(const std::vector<double>& speed, std::size_t size,
                                                std::size_t parts, std::size_t first) {
  std::vector<std::complex<double>> x(size);
  const double turn = -2 * std::numbers::pi * static_cast<double>(first) /
                      (static_cast<double>(size) * static_cast<double>(parts));
  for (std::size_t n = 0; n < speed.size(); ++n) {
    const double angle = turn * static_cast<double>(n);
    x[n] = {speed[n] * std::cos(angle), speed[n] * std::sin(angle)};
  }
  fft(x);
  return x;
}

// Magnitudes up to the cut-off, as a share of the largest of the whole spectrum. Empty for none.
// The padded signal is transformed in parts of the signal's own length, so that the padding takes
// no memory: X[parts j + r] is bin j of the transform of x[n] exp(-2 pi i r n / (size parts)).
std::vector<double> normalised_spectrum(const std::vector<double>& speed, double rate_hz) {
  const std::size_t size = std::bit_ceil(speed.size());
  const std::size_t padded = padded_size(speed.size()), parts = padded / size;
  const std::size_t below_nyquist = padded / 2 + 1;
  const double bin_hz = rate_hz / static_cast<double>(padded);
  const auto bins = static_cast<std::size_t>(kCutOffHz / bin_hz) + 1;
  std::vector<double> magnitude(std::min(bins, below_nyquist));
  double largest = 0;
  bool finite = true;
  for (std::size_t r = 0; r < parts; ++r) {
    const auto x = every_nth_bin(speed, size, parts, r);
    for (std::size_t k = r; k < below_nyquist; k += parts) {
      const double m = std::abs(x[k / parts]);
      finite = finite && std::isfinite(m);
      largest = std::max(largest, m);
      if (k < magnitude.size()) magnitude[k] = m;
    }
  }
  if (!(largest > 0) || !finite) return {};
  for (double& m : magnitude) m /= largest;
  return magnitude;
}

}  // namespace

double sparc(const std::vector<double>& speed, double rate_hz) {
  if (speed.size() < 2) return 0;
  const std::vector<double> m = normalised_spectrum(speed, rate_hz);
  const auto above = [](double value) { return value >= kThreshold; };
  const auto first = std::find_if(m.begin(), m.end(), above);
  const auto last = std::find_if(m.rbegin(), m.rend(), above).base();
  if (last - first < 2) return 0;
  // Both axes run from 0 to 1 over the band that is kept.
  const double step = 1 / static_cast<double>(last - first - 1);
  double arc = 0;
  for (auto it = first + 1; it != last; ++it) {
    const double rise = *it - *(it - 1);
    arc += std::sqrt(step * step + rise * rise);
  }
  return -arc;
}

}  // namespace osteon
