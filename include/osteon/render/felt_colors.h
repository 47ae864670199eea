#pragma once

#include <algorithm>
#include <array>
#include <cstddef>

namespace osteon {

/// How a surface is coloured by the height of what is felt over it: sRGB at -kFeltRange_m and less,
/// at 0 and at +kFeltRange_m and more; evenly in between.
inline constexpr double kFeltRange_m = 0.0005;
inline constexpr std::array<std::array<float, 3>, 3> kFeltColors{
    {{0.16f, 0.42f, 0.86f}, {0.90f, 0.89f, 0.86f}, {0.88f, 0.33f, 0.10f}}};

inline std::array<float, 3> felt_color(double height_m) {
  const auto share = static_cast<float>(std::clamp(height_m / kFeltRange_m, -1.0, 1.0));
  const auto& end = kFeltColors[share < 0 ? 0 : 2];
  const float way = share < 0 ? -share : share;
  std::array<float, 3> out{};
  for (std::size_t k = 0; k < 3; ++k)
    out[k] = kFeltColors[1][k] + way * (end[k] - kFeltColors[1][k]);
  return out;
}

}  // namespace osteon
