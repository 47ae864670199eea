#include "runs/hands/hand_settings.h"

#include <nlohmann/json.hpp>

#include "runs/hands/hand_settings_json.h"

namespace osteon {
namespace {

using Json = nlohmann::json;

double number_or(const Json& json, const char* key, double otherwise) {
  const auto it = json.find(key);
  return it != json.end() && it->is_number() ? it->get<double>() : otherwise;
}

int whole_or(const Json& json, const char* key, int otherwise) {
  const auto it = json.find(key);
  if (it == json.end() || !it->is_number_integer()) return otherwise;
  const auto value = it->get<std::int64_t>();
  return value >= -1 && value < 1024 ? static_cast<int>(value) : otherwise;
}

std::string text_or(const Json& json, const char* key, const char* otherwise) {
  const auto it = json.find(key);
  return it != json.end() && it->is_string() ? it->get<std::string>() : std::string(otherwise);
}

constexpr const char* kKinds[] = {"none", "key", "axis", "button"};

PedalSource parse_source(const Json& json) {
  PedalSource source;
  const std::string kind = text_or(json, "kind", "none");
  for (int i = 0; i < 4; ++i)
    if (kind == kKinds[i]) source.kind = static_cast<PedalKind>(i);
  source.joystick = text_or(json, "joystick", "");
  source.index = whole_or(json, "index", 0);
  source.rest = number_or(json, "rest", -1);
  source.full = number_or(json, "full", 1);
  return source;
}

}  // namespace

std::string mapping_key(const DeviceInfo& info, const std::string& case_name) {
  const std::string device = info.serial.empty() ? info.driver : info.driver + " " + info.serial;
  return device + " | " + case_name;
}

MappingSettings mapping_of(const MappingMap& mappings, const std::string& key) {
  const auto it = mappings.find(key);
  return it == mappings.end() ? MappingSettings{} : sane(it->second);
}

Json to_json_value(const MappingMap& mappings) {
  Json json = Json::object();
  for (const auto& [key, m] : mappings)
    json[key] = {{"scale", m.scale},
                 {"axes", m.axes == MappingAxes::kView ? "view" : "patient"},
                 {"clutch_button", m.clutch_button},
                 {"friction_n", m.friction_n},
                 {"inertia_kg", m.inertia_kg}};
  return json;
}

MappingMap parse_mappings(const Json& json) {
  MappingMap out;
  if (!json.is_object()) return out;
  for (const auto& [key, value] : json.items()) {
    if (!value.is_object()) continue;
    MappingSettings m;
    m.scale = number_or(value, "scale", m.scale);
    if (text_or(value, "axes", "view") == "patient") m.axes = MappingAxes::kPatient;
    m.clutch_button = whole_or(value, "clutch_button", m.clutch_button);
    m.friction_n = number_or(value, "friction_n", m.friction_n);
    m.inertia_kg = number_or(value, "inertia_kg", m.inertia_kg);
    out[key] = sane(m);
  }
  return out;
}

Json to_json_value(const PedalMap& pedals) {
  Json json = Json::object();
  for (const auto& [name, source] : pedals)
    json[name] = {{"kind", kKinds[static_cast<int>(source.kind)]},
                  {"joystick", source.joystick},
                  {"index", source.index},
                  {"rest", source.rest},
                  {"full", source.full}};
  return json;
}

PedalMap parse_pedals(const Json& json) {
  PedalMap out;
  if (!json.is_object()) return out;
  for (const auto& [name, value] : json.items())
    if (value.is_object()) out[name] = parse_source(value);
  return out;
}

}  // namespace osteon
