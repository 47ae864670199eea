#include <algorithm>
#include <bit>
#include <cmath>

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

// Magnitudes up to the cut-off, as a share of the largest of the whole spectrum. Empty for none.
std::vector<double> normalised_spectrum(const std::vector<double>& speed, double rate_hz) {
  std::vector<std::complex<double>> x(padded_size(speed.size()));
  std::copy(speed.begin(), speed.end(), x.begin());
  fft(x);
  const std::size_t below_nyquist = x.size() / 2 + 1;
  std::vector<double> magnitude(below_nyquist);
  for (std::size_t k = 0; k < below_nyquist; ++k) magnitude[k] = std::abs(x[k]);
  const double largest = *std::max_element(magnitude.begin(), magnitude.end());
  if (!(largest > 0) || !std::isfinite(largest)) return {};
  const double bin_hz = rate_hz / static_cast<double>(x.size());
  const auto bins = static_cast<std::size_t>(kCutOffHz / bin_hz) + 1;
  magnitude.resize(std::min(bins, below_nyquist));
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
