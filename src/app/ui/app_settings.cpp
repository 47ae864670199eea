#include "ui/app_settings.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>

#include "osteon/base/file.h"
#include "runs/hands/hand_settings_json.h"

namespace osteon {
namespace fs = std::filesystem;
namespace {

using Json = nlohmann::json;
constexpr std::uint64_t kLargestFile = 1u << 20;

void take(const Json& from, const char* key, bool& value) {
  const auto it = from.find(key);
  if (it != from.end() && it->is_boolean()) value = it->get<bool>();
}

void take(const Json& from, const char* key, std::string& value) {
  const auto it = from.find(key);
  if (it != from.end() && it->is_string()) value = it->get<std::string>();
}

void take(const Json& from, const char* key, double& value, double min, double max) {
  const auto it = from.find(key);
  if (it == from.end() || !it->is_number()) return;
  const double read = it->get<double>();
  if (std::isfinite(read) && read >= min && read <= max) value = read;
}

void take(const Json& from, const char* key, int& value, int min, int max) {
  double read = value;
  take(from, key, read, min, max);
  value = static_cast<int>(read);
}

Json to_json(const CaseLooks& looks) {
  Json cases = Json::object();
  for (const auto& [source, bones] : looks)
    for (const auto& [name, look] : bones)
      cases[source][name] = {
          {"color", look.color}, {"opacity", look.opacity}, {"visible", look.visible}};
  return cases;
}

std::optional<BoneLook> parse_look(const Json& json) {
  const auto color = json.find("color");
  if (color == json.end() || !color->is_array() || color->size() != 3) return std::nullopt;
  BoneLook look;
  for (std::size_t k = 0; k < 3; ++k) {
    const Json& channel = (*color)[k];
    if (!channel.is_number()) return std::nullopt;
    look.color[k] = std::clamp(channel.get<float>(), 0.0f, 1.0f);
    if (!std::isfinite(look.color[k])) return std::nullopt;
  }
  double opacity = 1;
  take(json, "opacity", opacity, 0, 1);
  look.opacity = static_cast<float>(opacity);
  take(json, "visible", look.visible);
  return look;
}

CaseLooks parse_looks(const Json& cases) {
  CaseLooks looks;
  if (!cases.is_object()) return looks;
  for (const auto& [source, bones] : cases.items()) {
    if (!bones.is_object()) continue;
    for (const auto& [name, json] : bones.items()) {
      if (!json.is_object()) continue;
      if (const auto look = parse_look(json)) looks[source][name] = *look;
    }
  }
  return looks;
}

}  // namespace

std::string to_json(const AppSettings& s) {
  const Json json = {{"window_width", s.window_width},
                     {"window_height", s.window_height},
                     {"interface_zoom", s.interface_zoom},
                     {"panels_open", s.panels_open},
                     {"left_card", s.left_card},
                     {"recent", s.recent},
                     {"hint_dismissed", s.hint_dismissed},
                     {"show_hulls", s.show_hulls},
                     {"show_felt", s.show_felt},
                     {"show_heat", s.show_heat},
                     {"show_force", s.show_force},
                     {"show_hand_ghost", s.show_hand_ghost},
                     {"light_azimuth_rad", s.light_azimuth_rad},
                     {"light_elevation_rad", s.light_elevation_rad},
                     {"light_brightness", s.light_brightness},
                     {"sound_volume", s.sound_volume},
                     {"ambient_occlusion", s.ambient_occlusion},
                     {"device", s.device},
                     {"stiffness_n_per_m", s.stiffness_n_per_m},
                     {"friction_scale", s.friction_scale},
                     {"bones_held", s.bones_held},
                     {"looks", to_json(s.looks)},
                     {"mappings", to_json_value(s.mappings)},
                     {"pedals", to_json_value(s.pedals)}};
  // `replace` keeps a device's odd name from throwing.
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

Result<AppSettings> parse_app_settings(const std::string& text) {
  const Json json = Json::parse(text, nullptr, false);
  if (!json.is_object()) return fail("is not a JSON object");
  AppSettings s;
  take(json, "window_width", s.window_width, 640, 16384);
  take(json, "window_height", s.window_height, 400, 16384);
  take(json, "interface_zoom", s.interface_zoom, 0.75, 2.5);
  take(json, "panels_open", s.panels_open);
  take(json, "left_card", s.left_card, 136, 360);
  if (const auto recent = json.find("recent"); recent != json.end() && recent->is_array())
    for (const Json& name : *recent)
      if (name.is_string()) s.recent.push_back(name.get<std::string>());
  take(json, "hint_dismissed", s.hint_dismissed);
  take(json, "show_hulls", s.show_hulls);
  take(json, "show_felt", s.show_felt);
  take(json, "show_heat", s.show_heat);
  take(json, "show_force", s.show_force);
  take(json, "show_hand_ghost", s.show_hand_ghost);
  take(json, "light_azimuth_rad", s.light_azimuth_rad, -3.15, 3.15);
  take(json, "light_elevation_rad", s.light_elevation_rad, -1.6, 1.6);
  take(json, "light_brightness", s.light_brightness, 0.2, 2.0);
  take(json, "sound_volume", s.sound_volume, 0.0, 1.0);
  take(json, "ambient_occlusion", s.ambient_occlusion, 0, 1);
  take(json, "device", s.device);
  take(json, "stiffness_n_per_m", s.stiffness_n_per_m, 200, 4000);
  take(json, "friction_scale", s.friction_scale, 0, 2);
  take(json, "bones_held", s.bones_held);
  if (const auto looks = json.find("looks"); looks != json.end()) s.looks = parse_looks(*looks);
  if (json.contains("mappings")) s.mappings = parse_mappings(json["mappings"]);
  if (json.contains("pedals")) s.pedals = parse_pedals(json["pedals"]);
  return s;
}

AppSettings load_app_settings(const fs::path& file, std::string* message) {
  std::error_code ec;
  if (!fs::exists(file, ec)) return {};
  const Result<std::string> text = read_file(file, kLargestFile);
  Result<AppSettings> parsed =
      text ? parse_app_settings(*text) : tl::unexpected<Error>(text.error());
  if (parsed) return *parsed;
  const fs::path aside = file.string() + ".damaged";
  fs::rename(file, aside, ec);
  if (message)
    *message =
        "The settings could not be read, so the defaults are in use. The old file was saved as " +
        aside.string() + ".";
  return {};
}

Result<void> save_app_settings(const AppSettings& settings, const fs::path& file) {
  std::error_code ec;
  fs::create_directories(file.parent_path(), ec);
  return write_file_atomic(file, to_json(settings));
}

}  // namespace osteon
