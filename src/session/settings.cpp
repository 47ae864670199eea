#include <algorithm>
#include <cmath>
#include <functional>
#include <nlohmann/json.hpp>
#include <numbers>
#include <set>

#include "osteon/session/session.h"

namespace osteon {
namespace {

using Json = nlohmann::ordered_json;

// A setting that is a number, and where it may lie.
struct NumberField {
  const char* group;
  const char* name;
  std::function<double&(SessionSettings&)> of;
  double min, max;
};

using S = SessionSettings;

const std::vector<NumberField>& number_fields() {
  static const std::vector<NumberField> fields = {
      {"haptic", "tick_s", [](S& s) -> double& { return s.haptic.tick_s; }, 1e-4, 1e-2},
      {"haptic", "stiffness_n_per_m", [](S& s) -> double& { return s.haptic.stiffness_n_per_m; }, 1,
       1e5},
      {"haptic", "damping_n_s_per_m", [](S& s) -> double& { return s.haptic.damping_n_s_per_m; }, 0,
       1e3},
      {"haptic", "friction_scale", [](S& s) -> double& { return s.haptic.friction_scale; }, 0, 10},
      {"haptic", "max_force_n", [](S& s) -> double& { return s.haptic.max_force_n; }, 0, 100},
      {"haptic", "max_slew_n_per_s", [](S& s) -> double& { return s.haptic.max_slew_n_per_s; }, 1,
       1e6},
      {"haptic", "max_turn_rad_per_tick",
       [](S& s) -> double& { return s.haptic.max_turn_rad_per_tick; }, 0, std::numbers::pi},
      {"physics", "step_s", [](S& s) -> double& { return s.physics.step_s; }, 1e-4, 0.1},
      {"physics", "spring_n_per_m", [](S& s) -> double& { return s.physics.spring_n_per_m; }, 0,
       1e7},
      {"physics", "spring_nm_per_rad", [](S& s) -> double& { return s.physics.spring_nm_per_rad; },
       0, 1e5},
      {"physics", "damping_ratio", [](S& s) -> double& { return s.physics.damping_ratio; }, 0, 100},
      {"portal_skin", "stiffness_n_per_m",
       [](S& s) -> double& { return s.portal_skin.stiffness_n_per_m; }, 1, 1e5},
      {"portal_skin", "static_friction",
       [](S& s) -> double& { return s.portal_skin.static_friction; }, 0, 10},
      {"portal_skin", "dynamic_friction",
       [](S& s) -> double& { return s.portal_skin.dynamic_friction; }, 0, 10},
      {"portal_skin", "squeeze_n", [](S& s) -> double& { return s.portal_skin.squeeze_n; }, 0, 100},
      {"", "force_limit_n", [](S& s) -> double& { return s.force_limit_n; }, 0.01, 100},
      {"", "probe_radius_m", [](S& s) -> double& { return s.probe_radius_m; }, 1e-4, 0.02},
  };
  return fields;
}

// A setting that is on or off.
struct FlagField {
  const char* group;
  const char* name;
  std::function<bool&(SessionSettings&)> of;
};

const std::vector<FlagField>& flag_fields() {
  static const std::vector<FlagField> fields = {
      {"haptic", "force_on", [](S& s) -> bool& { return s.haptic.force_on; }},
      {"physics", "hold_bones", [](S& s) -> bool& { return s.physics.hold_bones; }},
  };
  return fields;
}

constexpr const char* kTodo = "Correct the settings, or use those of another recording";

std::string path_of(const char* group, const char* name) {
  return *group ? std::string(group) + "." + name : std::string(name);
}

Json& group_of(Json& json, const char* group) { return *group ? json[group] : json; }

// A setting's value in the file, or nothing.
const Json* find(const Json& json, const char* group, const char* name) {
  const Json* holder = &json;
  if (*group) {
    const auto found = json.find(group);
    if (found == json.end() || !found->is_object()) return nullptr;
    holder = &*found;
  }
  const auto found = holder->find(name);
  return found == holder->end() ? nullptr : &*found;
}

Result<Json> parse_object(const std::string& text) {
  Json json = Json::parse(text, nullptr, false);
  if (json.is_discarded() || !json.is_object())
    return fail("the settings are not a JSON object", "settings", kTodo);
  return json;
}

// A setting that this version does not know may change what a recording means.
Result<void> check_keys(const Json& json) {
  SessionSettings defaults;
  const Json expected = Json::parse(to_json(defaults));
  for (const auto& [key, value] : json.items()) {
    if (!expected.contains(key)) return fail("unknown setting", "settings, '" + key + "'", kTodo);
    if (!expected[key].is_object() || !value.is_object()) continue;
    for (const auto& [name, ignored] : value.items())
      if (!expected[key].contains(name))
        return fail("unknown setting", "settings, '" + key + "." + name + "'", kTodo);
  }
  return {};
}

Result<void> read_hands(const Json& json, SessionSettings& settings) {
  const auto wrong = [] {
    return fail("a list of one to four hands with name and instrument is missing",
                "settings, 'hands'", kTodo);
  };
  const Json* hands = find(json, "", "hands");
  if (!hands || !hands->is_array()) return wrong();
  settings.hands.clear();
  for (const Json& hand : *hands) {
    if (!hand.is_object() || hand.size() != 2 || !hand.contains("name") ||
        !hand.contains("instrument") || !hand["name"].is_string() ||
        !hand["instrument"].is_number_unsigned())
      return wrong();
    settings.hands.push_back(
        {hand["name"].get<std::string>(), hand["instrument"].get<std::uint32_t>()});
  }
  return {};
}

Result<void> read_names(const Json& json, const char* key, std::vector<std::string>& into) {
  const std::string where = std::string("settings, '") + key + "'";
  const Json* names = find(json, "", key);
  if (!names || !names->is_array()) return fail("a list of names is missing", where, kTodo);
  into.clear();
  for (const Json& name : *names) {
    if (!name.is_string()) return fail("an entry is not a name", where, kTodo);
    into.push_back(name.get<std::string>());
  }
  return {};
}

Result<void> read_numbers(const Json& json, SessionSettings& settings) {
  for (const NumberField& field : number_fields()) {
    const Json* value = find(json, field.group, field.name);
    if (!value || !value->is_number())
      return fail("a number is missing", "settings, '" + path_of(field.group, field.name) + "'",
                  kTodo);
    field.of(settings) = value->get<double>();
  }
  return {};
}

Result<void> read_flags(const Json& json, SessionSettings& settings) {
  for (const FlagField& field : flag_fields()) {
    const Json* value = find(json, field.group, field.name);
    if (!value || !value->is_boolean())
      return fail("true or false is missing",
                  "settings, '" + path_of(field.group, field.name) + "'", kTodo);
    field.of(settings) = value->get<bool>();
  }
  return {};
}

constexpr double kMostGuided_n = 40, kMostIrrigation_ml_per_min = 2000;

// Stands in the settings of a session that carves alone.
Json carve_json(const CarveSettings& carve) {
  Json json{{"cell_m", carve.cell_m},
            {"cortex_m", carve.cortex_m},
            {"marrow_m", carve.marrow_m},
            {"thrust_scale", carve.thrust_scale}};
  if (carve.guided_n > 0) json["guided_n"] = carve.guided_n;
  if (carve.irrigation_ml_per_min > 0) json["irrigation_ml_per_min"] = carve.irrigation_ml_per_min;
  return json;
}

Result<void> check(const CarveSettings& carve) {
  const auto within = [](double x, double lo, double hi) { return x >= lo && x <= hi; };
  if (within(carve.cell_m, 5e-5, 2e-3) && within(carve.cortex_m, 0, 0.03) &&
      within(carve.marrow_m, 0, 0.03) && within(carve.thrust_scale, 0.1, 200) &&
      within(carve.guided_n, 0, kMostGuided_n) &&
      within(carve.irrigation_ml_per_min, 0, kMostIrrigation_ml_per_min))
    return {};
  return fail("a value is out of range", "settings, 'carve'",
              "Cells are 0.05 to 2 mm, layers 0 to 30 mm, the scale of thrust 0.1 to 200, "
              "the force along a guided line 0 to 40 N, irrigation 0 to 2000 ml/min");
}

Result<void> take_carve(Json& json, SessionSettings& settings) {
  const auto found = json.find("carve");
  if (found == json.end()) return {};
  Json carve = *found;
  json.erase(found);
  settings.carve.on = true;
  const std::pair<const char*, double*> numbers[] = {
      {"cell_m", &settings.carve.cell_m},
      {"cortex_m", &settings.carve.cortex_m},
      {"marrow_m", &settings.carve.marrow_m},
      {"thrust_scale", &settings.carve.thrust_scale}};
  // These stand there only where they are not 0.
  const std::pair<const char*, double*> others[] = {
      {"guided_n", &settings.carve.guided_n},
      {"irrigation_ml_per_min", &settings.carve.irrigation_ml_per_min}};
  for (const auto& [name, value] : others) {
    if (!carve.is_object() || !carve.contains(name) || !carve[name].is_number()) continue;
    *value = carve[name].get<double>();
    carve.erase(name);
  }
  if (!carve.is_object() || carve.size() != std::size(numbers))
    return fail("four numbers are expected", "settings, 'carve'", kTodo);
  for (const auto& [name, value] : numbers) {
    if (!carve.contains(name) || !carve[name].is_number())
      return fail("a number is missing", std::string("settings, 'carve.") + name + "'", kTodo);
    *value = carve[name].get<double>();
  }
  return {};
}

// Stands in the settings of a session with soft parts alone.
Result<void> take_soft(Json& json, SessionSettings& settings) {
  if (!json.contains("soft")) return {};
  if (auto done = read_names(json, "soft", settings.soft); !done) return done;
  const Json* hash = find(json, "", "soft_hash");
  if (settings.soft.empty() || !hash || !hash->is_number_unsigned())
    return fail("the soft parts that are felt, or their hash, are missing", "settings, 'soft'",
                kTodo);
  settings.soft_hash = hash->get<std::uint64_t>();
  json.erase("soft");
  json.erase("soft_hash");
  return {};
}

// Recordings of older versions do not say it.
Result<void> take_new(Json& json, const char* name, bool& value) {
  const auto found = json.find(name);
  value = found != json.end();
  if (!value) return {};
  if (!found->is_boolean())
    return fail("true or false is missing", "settings, '" + std::string(name) + "'", kTodo);
  value = found->get<bool>();
  json.erase(found);
  return {};
}

Result<void> check_hands(const SessionSettings& settings) {
  if (settings.hands.empty() || settings.hands.size() > kMaxHands)
    return fail("a session has one to four hands", "settings, 'hands'", "Give one to four names");
  std::set<std::string> names;
  const std::size_t instruments = std::max<std::size_t>(1, settings.tray.size());
  for (const HandSettings& hand : settings.hands) {
    if (!names.insert(hand.name).second)
      return fail("two hands are called '" + hand.name + "'", "settings, 'hands'",
                  "Give each a name of its own");
    if (hand.instrument >= instruments)
      return fail("hand '" + hand.name + "' holds an instrument that is not in the tray",
                  "settings, 'hands'", "Choose one of the tray's " + std::to_string(instruments));
  }
  return {};
}

}  // namespace

Result<void> check_settings(const SessionSettings& settings) {
  SessionSettings copy = settings;
  for (const NumberField& field : number_fields()) {
    const double value = field.of(copy);
    if (!(value >= field.min && value <= field.max))
      return fail(
          "the value is out of range", "settings, '" + path_of(field.group, field.name) + "'",
          "Choose a value from " + Json(field.min).dump() + " to " + Json(field.max).dump());
  }
  if (const auto done = check_hands(settings); !done) return done;
  if (const auto done = check(settings.carve); !done) return done;
  const double ticks = settings.physics.step_s / settings.haptic.tick_s;
  if (std::round(ticks) < 1 || std::abs(ticks - std::round(ticks)) > 1e-6)
    return fail("a physics step is not a whole number of haptic ticks",
                "settings, 'physics.step_s'", "Choose a multiple of 'haptic.tick_s'");
  return {};
}

std::string to_json(const SessionSettings& settings) {
  SessionSettings copy = settings;
  Json json = {{"seed", settings.seed}};
  for (const NumberField& field : number_fields())
    group_of(json, field.group)[field.name] = field.of(copy);
  for (const FlagField& field : flag_fields())
    group_of(json, field.group)[field.name] = field.of(copy);
  json["hands"] = Json::array();
  for (const HandSettings& hand : settings.hands)
    json["hands"].push_back({{"name", hand.name}, {"instrument", hand.instrument}});
  json["tray"] = settings.tray;
  json["portals"] = settings.portals;
  json["water"] = settings.water;
  json["sights"] = settings.sights;
  json["structures"] = settings.structures;
  json["soft_structures"] = settings.soft_structures;
  if (settings.carve.on) json["carve"] = carve_json(settings.carve);
  if (!settings.soft.empty()) {
    json["soft"] = settings.soft;
    json["soft_hash"] = settings.soft_hash;
  }
  return json.dump(2);
}

Result<SessionSettings> parse_settings(const std::string& json) {
  auto parsed = parse_object(json);
  if (!parsed) return tl::unexpected(parsed.error());
  SessionSettings settings;
  if (const auto done = take_carve(*parsed, settings); !done) return tl::unexpected(done.error());
  if (const auto done = take_soft(*parsed, settings); !done) return tl::unexpected(done.error());
  for (const auto& [name, value] :
       {std::pair{"water", &settings.water}, std::pair{"sights", &settings.sights},
        std::pair{"structures", &settings.structures},
        std::pair{"soft_structures", &settings.soft_structures}})
    if (const auto done = take_new(*parsed, name, *value); !done)
      return tl::unexpected(done.error());
  if (const auto done = check_keys(*parsed); !done) return tl::unexpected(done.error());
  const Json* seed = find(*parsed, "", "seed");
  if (!seed || !seed->is_number_unsigned())
    return fail("a whole number is missing", "settings, 'seed'", kTodo);
  settings.seed = seed->get<std::uint64_t>();
  if (const auto done = read_numbers(*parsed, settings); !done) return tl::unexpected(done.error());
  if (const auto done = read_flags(*parsed, settings); !done) return tl::unexpected(done.error());
  if (const auto done = read_hands(*parsed, settings); !done) return tl::unexpected(done.error());
  if (const auto done = read_names(*parsed, "tray", settings.tray); !done)
    return tl::unexpected(done.error());
  if (const auto done = read_names(*parsed, "portals", settings.portals); !done)
    return tl::unexpected(done.error());
  if (const auto done = check_settings(settings); !done) return tl::unexpected(done.error());
  return settings;
}

}  // namespace osteon
