#pragma once

#include "osteon/base/types.h"

namespace osteon {

inline constexpr double kScopeLamp_k = 5600;  ///< a usual light source of an arthroscope
inline constexpr double kLeastLamp_k = 2000, kMostLamp_k = 10000;

/// The colour of a scope's light, and the light that its camera takes for white, kelvin.
struct WhiteBalance {
  double light_k = kScopeLamp_k;
  double balance_k = kScopeLamp_k;
  bool operator==(const WhiteBalance&) const = default;
};

/// A black body's light in linear sRGB, with a luminance of 1; nothing is below 0. What is out of
/// range, or no number, is taken as the nearest that is in it, or as kScopeLamp_k.
Vec3 light_color(double kelvin);
/// What the camera shows of a white surface, in linear sRGB, with a luminance of 1: white where it
/// is balanced to the light.
Vec3 shown_white(const WhiteBalance& white);

}  // namespace osteon
