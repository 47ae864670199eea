#include "osteon/xray/attenuation.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace osteon {
namespace {

constexpr std::size_t kRows = 10;
using Row = std::array<double, kRows>;
constexpr Row kEnergy_kev = {10, 15, 20, 30, 40, 50, 60, 80, 100, 150};
// cm2/g. Soft tissue and cortical bone as ICRU report 44 has them.
constexpr std::array<Row, kXraySubstances> kAttenuation = {{
    {5.379, 1.699, 0.8230, 0.3790, 0.2688, 0.2264, 0.2048, 0.1823, 0.1693, 0.1492},
    {28.51, 9.032, 4.001, 1.331, 0.6655, 0.4242, 0.3148, 0.2229, 0.1855, 0.1480},
    {110.7, 35.87, 15.85, 4.972, 2.214, 1.213, 0.7661, 0.4052, 0.2721, 0.1649},
    {170.6, 57.08, 25.68, 8.176, 3.629, 1.958, 1.205, 0.5952, 0.3717, 0.1964},
}};
constexpr Row kAluminium = {26.23,  7.955,  3.441,  1.128,  0.5685,
                            0.3681, 0.2778, 0.2018, 0.1704, 0.1378};

double between_rows(const Row& values, double energy_kev) {
  const double e = std::clamp(energy_kev, kEnergy_kev.front(), kEnergy_kev.back());
  std::size_t n = 1;
  while (n + 1 < kRows && kEnergy_kev[n] < e) ++n;
  const double way =
      std::log(e / kEnergy_kev[n - 1]) / std::log(kEnergy_kev[n] / kEnergy_kev[n - 1]);
  return values[n - 1] * std::pow(values[n] / values[n - 1], way);
}

}  // namespace

double density_from_hu(double hu) {
  return std::max(0.0, std::min(0.001029 * hu + 1.03, 0.0005886 * hu + 1.03));
}

XrayMaterial material_of_hu(double hu) {
  return {hu >= 350 ? XraySubstance::kBone : XraySubstance::kSoft, density_from_hu(hu)};
}

double mass_attenuation_cm2_per_g(XraySubstance substance, double energy_kev) {
  return between_rows(kAttenuation[static_cast<std::size_t>(substance)], energy_kev);
}

double aluminium_attenuation_cm2_per_g(double energy_kev) {
  return between_rows(kAluminium, energy_kev);
}

}  // namespace osteon
