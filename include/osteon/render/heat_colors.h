#pragma once

#include <algorithm>
#include <array>
#include <cstddef>

namespace osteon {

/// How bone is coloured by the hottest temperature that it had: sRGB at these temperatures, evenly
/// in between; cooler bone keeps its own colour. 47 and 50 C are the limits of the rules for dying.
inline constexpr std::array<double, 5> kHeatStops_c{40, 44, 47, 50, 60};
inline constexpr std::array<std::array<float, 3>, 5> kHeatColors{{{0.96f, 0.93f, 0.72f},
                                                                  {0.98f, 0.84f, 0.30f},
                                                                  {0.96f, 0.55f, 0.12f},
                                                                  {0.86f, 0.19f, 0.12f},
                                                                  {0.50f, 0.03f, 0.08f}}};
/// Bone that died of it.
inline constexpr std::array<float, 3> kDeadColor{0.24f, 0.08f, 0.34f};

/// From the first stop on.
inline std::array<float, 3> heat_color(double celsius) {
  std::size_t k = 1;
  while (k + 1 < kHeatStops_c.size() && celsius > kHeatStops_c[k]) ++k;
  const double way = (celsius - kHeatStops_c[k - 1]) / (kHeatStops_c[k] - kHeatStops_c[k - 1]);
  const auto share = static_cast<float>(std::clamp(way, 0.0, 1.0));
  std::array<float, 3> out{};
  for (std::size_t c = 0; c < out.size(); ++c)
    out[c] = kHeatColors[k - 1][c] + share * (kHeatColors[k][c] - kHeatColors[k - 1][c]);
  return out;
}

}  // namespace osteon
