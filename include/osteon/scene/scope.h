#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "osteon/base/result.h"

namespace osteon {

/// An arthroscope's optics, as assets/scopes/<name>.toml has them.
struct ScopeDef {
  std::string name;   ///< "knee_30"
  std::string title;  ///< "Arthroscope 4 mm, 30 degrees"
  double diameter_m = 0.004;
  double angle_rad = 0;  ///< between the shaft and the middle of the view
  double field_rad = 1;  ///< whole width of the view in air
  /// How the picture bows: at the angle a from its middle it shows what lies tan(barrel a) of a
  /// radius out. 1: as a pinhole does; towards 0: evenly by the angle.
  double barrel = 1;
};

/// Whole width of the view through a flat window in water, by Snell's law (index 1.333).
double field_in_water_rad(const ScopeDef& scope);

/// Reads the text of a scope's file. Strict: an unknown or missing key and a number out of range
/// are errors, which name the line.
Result<ScopeDef> parse_scope(std::string_view text, const std::string& where);
/// The scope of this name that Osteon ships; the error lists the names there are.
Result<ScopeDef> load_scope(const std::string& name);
/// All names there are, sorted.
Result<std::vector<std::string>> scope_names();

}  // namespace osteon
