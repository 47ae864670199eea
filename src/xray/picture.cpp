#include "osteon/xray/picture.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <string>

#include "osteon/base/random.h"

namespace osteon {
namespace {

constexpr double kLowest_kev = 15, kBin_kev = 3;
constexpr double kAluminium_g_per_cm3 = 2.699;
/// A detector's signal is never darker than this share of the brightest.
constexpr double kFloor = 1e-6;

/// For metal, as a share of the range of tissue (both in logarithms): a seventh of all.
constexpr double kRoomForMetal = 1.0 / 6;

/// Poisson deviate: by multiplying uniform numbers where few are expected (Knuth), by the normal
/// deviate of the same mean and variance where many are.
double poisson(Random& random, double mean) {
  if (mean > 60) return std::max(0.0, std::round(random.normal(mean, std::sqrt(mean))));
  const double end = std::exp(-mean);
  double product = random.uniform();
  int count = 0;
  for (; product > end; ++count) product *= random.uniform();
  return count;
}

void add_noise(std::vector<float>& signal, const XrayDetector& detector) {
  Random random(detector.seed);
  for (float& s : signal)
    s = static_cast<float>(poisson(random, detector.photons * static_cast<double>(s)) /
                           detector.photons);
}

/// (1 2 1) / 4 along a line of `count` values `stride` apart; the ends count twice.
void blur_line(float* line, int count, int stride) {
  float before = line[0];
  for (int n = 0; n < count; ++n) {
    float& here = line[n * stride];
    const float was = here, next = n + 1 < count ? line[(n + 1) * stride] : here;
    here = 0.25f * before + 0.5f * was + 0.25f * next;
    before = was;
  }
}

double quantile(std::vector<float>& values, double share) {
  const auto at = static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), values.begin() + at, values.end());
  return values[static_cast<std::size_t>(at)];
}

float metal_at(const ArealDensity& density, std::size_t n) {
  return density.of[static_cast<std::size_t>(XraySubstance::kTitanium)][n] +
         density.of[static_cast<std::size_t>(XraySubstance::kIron)][n];
}

bool has_metal(const ArealDensity& density) {
  for (std::size_t n = 0; n < density.of[0].size(); ++n)
    if (metal_at(density, n) > 0) return true;
  return false;
}

/// Metal in a pixel or one of the eight about it.
bool near_metal(const ArealDensity& density, int column, int row) {
  for (int y = std::max(0, row - 1); y <= std::min(density.height - 1, row + 1); ++y)
    for (int x = std::max(0, column - 1); x <= std::min(density.width - 1, column + 1); ++x)
      if (metal_at(density, static_cast<std::size_t>(y) * static_cast<std::size_t>(density.width) +
                                static_cast<std::size_t>(x)) > 0)
        return true;
  return false;
}

/// Signals of the pixels that something covers, with or without those near metal.
std::vector<float> covered_signals(const std::vector<float>& signal, const ArealDensity& density,
                                   bool with_metal) {
  const std::vector<float> total = density.total();
  std::vector<float> covered;
  std::size_t n = 0;
  for (int row = 0; row < density.height; ++row)
    for (int column = 0; column < density.width; ++column, ++n)
      if (total[n] > 0 && (with_metal || !near_metal(density, column, row)))
        covered.push_back(signal[n]);
  return covered;
}

/// Shares of each energy, and what of it a gram on a square centimetre lets through.
struct WeightedBin {
  double weight;
  std::array<double, kXraySubstances> per_g;
};

std::vector<WeightedBin> weighted(const XraySpectrum& spectrum) {
  std::vector<WeightedBin> bins;
  double all = 0;
  for (const auto& bin : spectrum.bins) all += bin.share * bin.energy_kev;
  for (const auto& bin : spectrum.bins) {
    WeightedBin w{bin.share * bin.energy_kev / all, {}};
    for (std::size_t s = 0; s < kXraySubstances; ++s)
      w.per_g[s] = mass_attenuation_cm2_per_g(static_cast<XraySubstance>(s), bin.energy_kev);
    bins.push_back(w);
  }
  return bins;
}

}  // namespace

Result<XraySpectrum> tube_spectrum(double kv, double filter_mm) {
  if (!(kv >= 40 && kv <= 120))
    return fail("the tube's voltage must be 40 to 120 kV", "X-ray tube");
  if (!(filter_mm >= 0 && filter_mm <= 20))
    return fail("the filter must be 0 to 20 mm of aluminium", "X-ray tube");
  XraySpectrum spectrum;
  double all = 0;
  for (double e = kLowest_kev + 0.5 * kBin_kev; e < kv; e += kBin_kev) {
    const double through =
        std::exp(-aluminium_attenuation_cm2_per_g(e) * kAluminium_g_per_cm3 * 0.1 * filter_mm);
    spectrum.bins.push_back({e, (kv / e - 1) * through});
    all += spectrum.bins.back().share;
  }
  for (auto& bin : spectrum.bins) bin.share /= all;
  return spectrum;
}

std::vector<float> transmitted(const ArealDensity& density, const XraySpectrum& spectrum) {
  const std::vector<WeightedBin> bins = weighted(spectrum);
  std::vector<float> out(density.of[0].size(), 1);
  for (std::size_t n = 0; n < out.size(); ++n) {
    std::array<double, kXraySubstances> mass;
    double any = 0;
    for (std::size_t s = 0; s < kXraySubstances; ++s)
      any += mass[s] = static_cast<double>(density.of[s][n]);
    if (any == 0) continue;
    double sum = 0;
    for (const WeightedBin& bin : bins) {
      double depth = 0;
      for (std::size_t s = 0; s < kXraySubstances; ++s) depth += bin.per_g[s] * mass[s];
      sum += bin.weight * std::exp(-depth);
    }
    out[n] = static_cast<float>(sum);
  }
  return out;
}

std::vector<float> detected(const std::vector<float>& transmitted, int width,
                            const XrayDetector& detector) {
  std::vector<float> signal = transmitted;
  if (detector.noise && detector.photons > 0) add_noise(signal, detector);
  if (!detector.blur || width <= 0) return signal;
  const int height = static_cast<int>(signal.size() / static_cast<std::size_t>(width));
  for (int row = 0; row < height; ++row)
    blur_line(signal.data() + static_cast<std::ptrdiff_t>(row) * width, width, 1);
  for (int column = 0; column < width && height > 0; ++column)
    blur_line(signal.data() + column, height, width);
  return signal;
}

XrayWindow automatic_window(const std::vector<float>& signal, const ArealDensity& density) {
  std::vector<float> covered = covered_signals(signal, density, false);
  const bool tissue = !covered.empty();
  if (!tissue) covered = covered_signals(signal, density, true);
  if (covered.empty()) return {};
  XrayWindow window;
  window.dark = std::max(kFloor, quantile(covered, 0.005));
  window.bright = std::max(1.1 * window.dark, quantile(covered, 0.995));
  if (tissue && has_metal(density))
    window.dark =
        std::max(kFloor, window.dark * std::pow(window.dark / window.bright, kRoomForMetal));
  return window;
}

std::vector<float> shown(const std::vector<float>& signal, const XrayWindow& window) {
  const double from = std::log(window.dark), range = std::log(window.bright) - from;
  std::vector<float> out(signal.size());
  for (std::size_t n = 0; n < out.size(); ++n) {
    const double s = std::max(kFloor, static_cast<double>(signal[n]));
    out[n] = static_cast<float>(std::clamp((std::log(s) - from) / range, 0.0, 1.0));
  }
  return out;
}

}  // namespace osteon
