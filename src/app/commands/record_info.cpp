#include "commands/record_info.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <nlohmann/json.hpp>

namespace osteon {
namespace {

using Json = nlohmann::ordered_json;

constexpr double kTick_s = 0.001;

double tick_s(const RecordingHeader& header) {
  const Json settings = Json::parse(header.settings_json, nullptr, false);
  if (settings.is_discarded() || !settings.is_object()) return kTick_s;
  const Json haptic = settings.value("haptic", Json::object());
  return haptic.is_object() ? haptic.value("tick_s", kTick_s) : kTick_s;
}

std::string hex(std::uint64_t value) {
  std::array<char, 17> text{};
  std::snprintf(text.data(), text.size(), "%016llx", static_cast<unsigned long long>(value));
  return text.data();
}

std::string line(const char* name, const std::string& value) {
  std::string text = name;
  text.resize(std::max<std::size_t>(text.size() + 1, 16), ' ');
  return text + value + "\n";
}

std::string fixed(double value, int decimals) {
  std::array<char, 64> text{};
  std::snprintf(text.data(), text.size(), "%.*f", decimals, value);
  return text.data();
}

constexpr std::array<const char*, 9> kSubjects = {
    "", "bone", "soft part", "landmark", "instrument", "portal", "restore point", "cause", "hand"};

Json event_json(const RecordingHeader& header, const Event& event, double dt) {
  const EventKindRow* row = find_event_kind(event.kind);
  Json json = {{"time_s", static_cast<double>(event.tick) * dt},
               {"tick", event.tick},
               {"kind", row ? std::string(row->name)
                            : "unknown_" + std::to_string(static_cast<int>(event.kind))},
               {"hand", hand_name(header, event.hand)}};
  if (event.subject != kNoSubject) {
    json["subject_kind"] = kSubjects[std::min<std::size_t>(
        static_cast<std::size_t>(event.subject_kind), kSubjects.size() - 1)];
    json["subject"] = event.subject;
  }
  json["position_m"] = {event.p_W.x(), event.p_W.y(), event.p_W.z()};
  for (std::size_t i = 0; row && i < event.values.size(); ++i)
    if (!row->value_names[i].empty()) json[std::string(row->value_names[i])] = event.values[i];
  return json;
}

std::string event_line(const RecordingHeader& header, const Event& event, double dt) {
  const EventKindRow* row = find_event_kind(event.kind);
  std::string text = fixed(static_cast<double>(event.tick) * dt, 3) + " s  ";
  if (header.hands > 1) text += hand_name(header, event.hand) + "  ";
  text += row ? std::string(row->name) : "kind " + std::to_string(static_cast<int>(event.kind));
  if (const std::string subject = subject_text(event); !subject.empty()) text += "  " + subject;
  for (std::size_t i = 0; row && i < event.values.size(); ++i)
    if (!row->value_names[i].empty())
      text += "  " + std::string(row->value_names[i]) + " " + fixed(event.values[i], 3);
  return text + "\n";
}

Json info_json(RecordingReader& recording, const std::vector<StoredState>& states) {
  const RecordingHeader& header = recording.header();
  const double dt = tick_s(header);
  Json json = {{"case", header.case_name},
               {"case_source", header.case_source},
               {"case_path", header.case_path},
               {"case_hash", hex(header.case_hash)},
               {"osteon_version", header.osteon_version},
               {"complete", recording.complete()}};
  Json hands = Json::object();
  for (std::size_t h = 0; h < header.hands; ++h)
    hands[hand_name(header, h)] = {{"ticks", recording.ticks(h)},
                                   {"duration_s", static_cast<double>(recording.ticks(h)) * dt}};
  json["hands"] = hands;
  json["steps"] = recording.steps();
  json["events"] = recording.events();
  json["bytes"] = recording.bytes();
  Json times = Json::array();
  for (const StoredState& state : states) times.push_back(static_cast<double>(state.ticks[0]) * dt);
  json["states_s"] = times;
  return json;
}

}  // namespace

std::string hand_name(const RecordingHeader& header, std::size_t hand) {
  const Json settings = Json::parse(header.settings_json, nullptr, false);
  const Json hands = settings.is_object() ? settings.value("hands", Json::array()) : Json::array();
  if (hands.is_array() && hand < hands.size() && hands[hand].is_object()) {
    const Json name = hands[hand].value("name", Json());
    if (name.is_string() && !name.get<std::string>().empty()) return name.get<std::string>();
  }
  return "hand_" + std::to_string(hand + 1);
}

std::string subject_text(const Event& event) {
  const auto kind = static_cast<std::size_t>(event.subject_kind);
  if (event.subject == kNoSubject || kind == 0) return {};
  const std::string name = kind < kSubjects.size() ? kSubjects[kind] : "subject";
  return name + " " + std::to_string(event.subject);
}

Result<std::string> recording_info(RecordingReader& recording, bool json) {
  const auto states = recording.states();
  if (!states) return tl::unexpected(states.error());
  const Json info = info_json(recording, *states);
  if (json) return info.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
  const RecordingHeader& header = recording.header();
  const double dt = tick_s(header);
  std::string text = line("case", header.case_name + " (" + header.case_source + ")");
  text += line("made by", "Osteon " + header.osteon_version);
  double longest_s = 0;
  for (std::size_t h = 0; h < header.hands; ++h) {
    const double s = static_cast<double>(recording.ticks(h)) * dt;
    longest_s = std::max(longest_s, s);
    text += line("hand", hand_name(header, h) + ", " + fixed(s, 3) + " s, " +
                             std::to_string(recording.ticks(h)) + " ticks");
  }
  text += line("physics", std::to_string(recording.steps()) + " steps");
  text += line("events", std::to_string(recording.events()));
  text += line("states", std::to_string(states->size()) + " to begin a replay at");
  text += line("size", fixed(static_cast<double>(recording.bytes()) * 1e-3, 1) + " kB" +
                           (longest_s > 0 ? ", " +
                                                fixed(static_cast<double>(recording.bytes()) *
                                                          1e-3 / longest_s / header.hands,
                                                      1) +
                                                " kB a second and hand"
                                          : std::string()));
  if (!recording.complete()) text += "incomplete: the recording breaks off\n";
  return text;
}

Result<std::string> event_lines(RecordingReader& recording, bool json) {
  const double dt = tick_s(recording.header());
  std::string text;
  for (std::uint64_t next = 1;;) {
    const auto events = recording.read_events(next);
    if (!events) return tl::unexpected(events.error());
    if (events->empty()) return text;
    next += events->size();
    for (const Event& event : *events)
      text += json ? event_json(recording.header(), event, dt)
                             .dump(-1, ' ', false, Json::error_handler_t::replace) +
                         "\n"
                   : event_line(recording.header(), event, dt);
  }
}

}  // namespace osteon
