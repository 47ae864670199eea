#pragma once

#include <algorithm>
#include <cmath>

namespace osteon {

/// To what the device's axes are tied.
enum class MappingAxes {
  kView,    ///< right, up and towards the user as the picture shows them
  kPatient  ///< x along World x, up is World z: the same whatever the camera does
};

/// How one device is used on one case; the user's, saved.
struct MappingSettings {
  double scale = 1;  ///< 2: 1 cm at the hand is 2 cm in the case
  MappingAxes axes = MappingAxes::kView;
  int clutch_button = -1;  ///< of the device: while held, it moves without the tool; -1: none
  double friction_n = 0;   ///< of the device itself, to be made up for; 0: not
  double inertia_kg = 0;   ///< of its moving parts, to be made up for; 0: not

  bool operator==(const MappingSettings&) const = default;
};

inline constexpr double kMinScale = 0.1, kMaxScale = 5;
inline constexpr double kMaxFriction_n = 1, kMaxInertia_kg = 0.2;

/// `settings` with every value in its range; what is no number becomes the default.
inline MappingSettings sane(MappingSettings settings) {
  const auto within = [](double x, double lo, double hi, double otherwise) {
    return std::isfinite(x) ? std::clamp(x, lo, hi) : otherwise;
  };
  settings.scale = within(settings.scale, kMinScale, kMaxScale, 1);
  settings.friction_n = within(settings.friction_n, 0, kMaxFriction_n, 0);
  settings.inertia_kg = within(settings.inertia_kg, 0, kMaxInertia_kg, 0);
  if (settings.clutch_button < -1 || settings.clutch_button > 31) settings.clutch_button = -1;
  return settings;
}

}  // namespace osteon
