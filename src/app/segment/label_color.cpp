#include "segment/label_color.h"

#include <cmath>

namespace osteon {

std::array<float, 3> label_color_rgb(std::uint16_t label) {
  // Steps of the golden ratio around the colour circle spread any number of hues evenly.
  const float turns = 0.10f + 0.618034f * static_cast<float>(label);
  const float hue = 6 * (turns - std::floor(turns));
  constexpr float kValue = 0.92f, kSaturation = 0.58f;
  std::array<float, 3> rgb{};
  for (std::size_t channel = 0; channel < 3; ++channel) {
    const float k = std::fmod(5.0f - 2.0f * static_cast<float>(channel) + hue, 6.0f);
    const float dip = std::fmax(0.0f, std::fmin(std::fmin(k, 4.0f - k), 1.0f));
    rgb[channel] = kValue * (1 - kSaturation * dip);
  }
  return rgb;
}

std::uint32_t label_color(std::uint16_t label) {
  const std::array<float, 3> rgb = label_color_rgb(label);
  std::uint32_t out = 0xff000000u;
  for (std::size_t channel = 0; channel < 3; ++channel)
    out |= static_cast<std::uint32_t>(std::lround(255 * rgb[channel])) << (8 * channel);
  return out;
}

}  // namespace osteon
