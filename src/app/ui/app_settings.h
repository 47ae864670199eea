#pragma once

#include <array>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "osteon/base/result.h"
#include "runs/hands/hand_settings.h"

namespace osteon {

/// How a bone of a case is drawn, where that is not the usual.
struct BoneLook {
  std::array<float, 3> color{};  ///< sRGB, 0..1
  float opacity = 1;
  bool visible = true;
  bool operator==(const BoneLook&) const = default;
};
/// Looks by a case's source, then by the bone's name.
using CaseLooks = std::map<std::string, std::map<std::string, BoneLook>>;

/// What the window remembers between runs.
struct AppSettings {
  int window_width = 1280, window_height = 720;
  double interface_zoom = 1;  ///< on top of the display's own scale; 0.75 to 2.5
  bool panels_open = true;
  double left_card = 0;  ///< width of the left card, units of the interface; 0: not dragged
  std::vector<std::string> recent;  ///< cases and recordings opened, the last one first
  bool hint_dismissed = false;
  bool show_hulls = false;
  bool show_felt = false;
  bool show_heat = false;
  bool show_force = true;
  bool show_hand_ghost = true;
  double light_azimuth_rad = -0.7;
  double light_elevation_rad = 0.8;
  double light_brightness = 1;
  double sound_volume = 0.5;  ///< 0 to 1
  double ambient_occlusion = 1;
  std::string device = "mouse";  ///< its driver's name
  double stiffness_n_per_m = 2000;
  double friction_scale = 1;
  bool bones_held = true;
  CaseLooks looks;
  MappingMap mappings;  ///< scale, axes and clutch of each device on each case
  PedalMap pedals;

  bool operator==(const AppSettings&) const = default;
};

std::string to_json(const AppSettings& settings);
/// A value that is missing, of another type or out of range keeps its default. Fails only when the
/// text is no JSON object at all.
Result<AppSettings> parse_app_settings(const std::string& json);

/// Settings of `file`, or the defaults when there is none. `message` gets words for the user when a
/// file was there and could not be used; it is then kept beside as `<file>.damaged`.
AppSettings load_app_settings(const std::filesystem::path& file, std::string* message);
/// In one step; makes the folder.
Result<void> save_app_settings(const AppSettings& settings, const std::filesystem::path& file);

}  // namespace osteon
