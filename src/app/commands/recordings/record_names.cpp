#include "commands/recordings/record_names.h"

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>

#include "osteon/device/haptic_device.h"

namespace osteon {
namespace {

using ParsedJson = nlohmann::json;

struct KindOfSubject {
  const char* name;  ///< as a reader knows it
  const char* key;   ///< in the header's names; null: it has none
};

constexpr auto kLastCause = static_cast<std::uint32_t>(ForceOff::kDeviceFault);

// By SubjectKind.
constexpr std::array<KindOfSubject, 9> kKinds = {{{"", nullptr},
                                                  {"bone", "bones"},
                                                  {"soft part", "soft_parts"},
                                                  {"landmark", "landmarks"},
                                                  {"instrument", "instruments"},
                                                  {"portal", "portals"},
                                                  {"restore point", nullptr},
                                                  {"cause", nullptr},
                                                  {"hand", "hands"}}};

std::vector<std::string> texts_of(const ParsedJson& object, const char* key) {
  std::vector<std::string> out;
  if (!key || !object.is_object() || !object.contains(key) || !object[key].is_array()) return out;
  for (const ParsedJson& text : object[key])
    out.push_back(text.is_string() ? text.get<std::string>() : std::string());
  return out;
}

}  // namespace

std::vector<std::string> hand_names(const RecordingHeader& header) {
  const ParsedJson settings = ParsedJson::parse(header.settings_json, nullptr, false);
  std::vector<std::string> names;
  for (std::uint32_t h = 0; h < header.hands; ++h) names.push_back("hand_" + std::to_string(h + 1));
  if (!settings.is_object() || !settings.contains("hands")) return names;
  const ParsedJson& hands = settings["hands"];
  for (std::size_t h = 0; hands.is_array() && h < std::min(names.size(), hands.size()); ++h) {
    if (!hands[h].is_object() || !hands[h].contains("name")) continue;
    const ParsedJson& name = hands[h]["name"];
    if (name.is_string() && !name.get<std::string>().empty()) names[h] = name.get<std::string>();
  }
  return names;
}

double recorded_tick_s(const RecordingHeader& header) {
  constexpr double kUsual_s = 0.001;
  const ParsedJson settings = ParsedJson::parse(header.settings_json, nullptr, false);
  if (!settings.is_object()) return kUsual_s;
  const ParsedJson haptic = settings.value("haptic", ParsedJson::object());
  if (!haptic.is_object() || !haptic.contains("tick_s") || !haptic["tick_s"].is_number())
    return kUsual_s;
  return haptic["tick_s"].get<double>();
}

RecordNames::RecordNames(const RecordingHeader& header) : hands_(hand_names(header)) {
  for (std::size_t h = hands_.size(); h < kNoHand; ++h)
    hands_.push_back("hand_" + std::to_string(h + 1));
  hands_.emplace_back();  // an event that no hand had to do with
  const ParsedJson names = ParsedJson::parse(header.names_json, nullptr, false);
  for (const KindOfSubject& kind : kKinds) by_kind_.push_back(texts_of(names, kind.key));
}

const std::string& RecordNames::hand(std::size_t hand) const {
  return hands_[std::min(hand, hands_.size() - 1)];
}

std::string RecordNames::subject_kind(const Event& event) {
  const auto kind = static_cast<std::size_t>(event.subject_kind);
  if (event.subject == kNoSubject || kind == 0) return {};
  return kind < kKinds.size() ? kKinds[kind].name : "subject";
}

std::string RecordNames::subject(const Event& event) const {
  const auto kind = static_cast<std::size_t>(event.subject_kind);
  if (event.subject == kNoSubject || kind == 0) return {};
  if (event.subject_kind == SubjectKind::kDevice && event.subject <= kLastCause)
    return describe(static_cast<ForceOff>(event.subject));
  if (kind < by_kind_.size() && event.subject < by_kind_[kind].size() &&
      !by_kind_[kind][event.subject].empty())
    return by_kind_[kind][event.subject];
  return std::to_string(event.subject);
}

}  // namespace osteon
