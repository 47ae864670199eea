#include "view/exposure.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace osteon {

double exposure_gain(std::span<const double> light) {
  std::vector<double> counted;
  counted.reserve(light.size());
  double sum = 0;
  for (const double value : light) {
    if (!std::isfinite(value)) continue;
    counted.push_back(std::clamp(value, 1e-4, 1e2));
    sum += std::log(counted.back());
  }
  if (counted.empty()) return 1;
  const auto count = static_cast<double>(counted.size());
  const auto sparks = static_cast<std::ptrdiff_t>(kMaySpark * count);
  const auto bright = counted.end() - 1 - sparks;
  std::nth_element(counted.begin(), bright, counted.end());
  const double gain = std::min(kMeanLight / std::exp(sum / count), kMostLight / *bright);
  return std::clamp(gain, 0.01, 50.0);
}

}  // namespace osteon
