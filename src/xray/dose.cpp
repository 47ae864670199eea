#include "osteon/xray/dose.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace osteon {

double kerma_mgy_per_mas(double kv) {
  constexpr std::array<double, 3> kKv = {60, 90, 120}, kKerma = {0.069, 0.138, 0.224};
  const std::size_t n = kv < kKv[1] ? 0 : 1;
  const double power = std::log(kKerma[n + 1] / kKerma[n]) / std::log(kKv[n + 1] / kKv[n]);
  return kKerma[n] * std::pow(kv / kKv[n], power);
}

XrayDose dose_of(const XrayExposure& exposure, const XrayView& view) {
  XrayDose dose;
  dose.shots = exposure.shots;
  dose.seconds = exposure.shots * exposure.pulse_s;
  dose.air_kerma_mgy = kerma_mgy_per_mas(exposure.kv) * exposure.mas * exposure.shots;
  const double scale = kDoseDistance_m / view.source_detector_m();
  const double detector_cm2 = 1e4 * view.pixel_m * view.pixel_m * view.width * view.height;
  dose.beam_area_cm2 = detector_cm2 * scale * scale;
  dose.kerma_area_mgy_cm2 = dose.air_kerma_mgy * dose.beam_area_cm2;
  return dose;
}

double automatic_mas(double share, double clear_mas, double most_mas) {
  return share * most_mas > clear_mas ? clear_mas / std::min(share, 1.0) : most_mas;
}

double mean_in_middle(const std::vector<float>& values, int width) {
  if (width <= 0 || values.empty()) return 0;
  const int height = static_cast<int>(values.size() / static_cast<std::size_t>(width));
  double sum = 0, count = 0;
  for (int row = height / 4; row < std::max(height / 4 + 1, height - height / 4); ++row)
    for (int column = width / 4; column < std::max(width / 4 + 1, width - width / 4); ++column) {
      sum += static_cast<double>(
          values[static_cast<std::size_t>(row) * static_cast<std::size_t>(width) +
                 static_cast<std::size_t>(column)]);
      count += 1;
    }
  return count > 0 ? sum / count : 0;
}

}  // namespace osteon
