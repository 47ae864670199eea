#include "commands/recordings/record_info.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "commands/recordings/record_names.h"
#include "commands/support/text_table.h"

namespace osteon {
namespace {

using Json = nlohmann::ordered_json;

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

Json event_json(const RecordNames& names, const Event& event, double dt) {
  const EventKindRow* row = find_event_kind(event.kind);
  Json json = {{"time_s", static_cast<double>(event.tick) * dt},
               {"tick", event.tick},
               {"kind", row ? std::string(row->name)
                            : "unknown_" + std::to_string(static_cast<int>(event.kind))},
               {"hand", names.hand(event.hand)}};
  if (const std::string kind = RecordNames::subject_kind(event); !kind.empty()) {
    json["subject_kind"] = kind;
    json["subject"] = names.subject(event);
    json["subject_index"] = event.subject;
  }
  json["position_m"] = {event.p_W.x(), event.p_W.y(), event.p_W.z()};
  for (std::size_t i = 0; row && i < event.values.size(); ++i)
    if (!row->value_names[i].empty()) json[std::string(row->value_names[i])] = event.values[i];
  return json;
}

std::string event_line(const RecordNames& names, bool one_hand, const Event& event, double dt) {
  const EventKindRow* row = find_event_kind(event.kind);
  std::string text = fixed(static_cast<double>(event.tick) * dt, 3) + " s  ";
  if (!one_hand) text += names.hand(event.hand) + "  ";
  text += row ? std::string(row->name) : "kind " + std::to_string(static_cast<int>(event.kind));
  if (const std::string kind = RecordNames::subject_kind(event); !kind.empty())
    text += "  " + kind + " " + names.subject(event);
  for (std::size_t i = 0; row && i < event.values.size(); ++i)
    if (!row->value_names[i].empty())
      text += "  " + std::string(row->value_names[i]) + " " + fixed(event.values[i], 3);
  return text + "\n";
}

Json info_json(RecordingReader& recording, const std::vector<StoredState>& states) {
  const RecordingHeader& header = recording.header();
  const double dt = recorded_tick_s(header);
  Json json = {{"case", header.case_name},
               {"case_source", header.case_source},
               {"case_path", header.case_path},
               {"case_hash", hex(header.case_hash)},
               {"osteon_version", header.osteon_version},
               {"complete", recording.complete()}};
  const std::vector<std::string> names = hand_names(header);
  Json hands = Json::object();
  for (std::size_t h = 0; h < header.hands; ++h)
    hands[names[h]] = {{"ticks", recording.ticks(h)},
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

Result<std::string> recording_info(RecordingReader& recording, bool json,
                                   std::span<const TorqueReport> torques) {
  const auto states = recording.states();
  if (!states) return tl::unexpected(states.error());
  const std::vector<std::string> names = hand_names(recording.header());
  Json info = info_json(recording, *states);
  for (std::size_t h = 0; h < std::min(names.size(), torques.size()); ++h)
    info["hands"][names[h]]["torque"] = to_json(torques[h]);
  if (json) return info.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
  const RecordingHeader& header = recording.header();
  const double dt = recorded_tick_s(header);
  std::string text = line("case", header.case_name + " (" + header.case_source + ")");
  text += line("made by", "Osteon " + header.osteon_version);
  double longest_s = 0;
  for (std::size_t h = 0; h < header.hands; ++h) {
    const double s = static_cast<double>(recording.ticks(h)) * dt;
    longest_s = std::max(longest_s, s);
    text += line("hand", names[h] + ", " + fixed(s, 3) + " s, " +
                             std::to_string(recording.ticks(h)) + " ticks");
    if (h < torques.size()) text += to_text(torques[h]);
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
  if (!recording.complete()) text += "incomplete: the recording is truncated\n";
  return text;
}

Result<void> tell_events(RecordingReader& recording, bool json,
                         const std::function<void(const std::string& line)>& tell) {
  const double dt = recorded_tick_s(recording.header());
  const RecordNames names(recording.header());
  const bool one_hand = recording.header().hands == 1;
  for (std::uint64_t next = 1;;) {
    const auto events = recording.read_events(next);
    if (!events) return tl::unexpected(events.error());
    if (events->empty()) return {};
    next += events->size();
    for (const Event& event : *events)
      tell(json
               ? event_json(names, event, dt).dump(-1, ' ', false, Json::error_handler_t::replace) +
                     "\n"
               : event_line(names, one_hand, event, dt));
  }
}

}  // namespace osteon
