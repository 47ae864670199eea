#include "checkup/finding.h"

#include <algorithm>
#include <nlohmann/json.hpp>

namespace osteon {
namespace {

const char* mark(FindingLevel level) {
  switch (level) {
    case FindingLevel::kGood:
      return "ok  ";
    case FindingLevel::kNote:
      return "note";
    case FindingLevel::kBad:
      return "BAD ";
  }
  return "";
}

const char* name(FindingLevel level) {
  return level == FindingLevel::kGood ? "good" : level == FindingLevel::kNote ? "note" : "bad";
}

// Further lines of a text start below its first.
std::string indented(const std::string& text, std::size_t columns) {
  std::string out;
  for (const char c : text) {
    out += c;
    if (c == '\n') out.append(columns, ' ');
  }
  return out;
}

}  // namespace

FindingLevel worst(const Findings& findings) {
  FindingLevel level = FindingLevel::kGood;
  for (const Finding& f : findings) level = std::max(level, f.level);
  return level;
}

std::string to_text(const Findings& findings) {
  constexpr std::size_t kTopic = 20, kText = 6 + kTopic;
  std::string out;
  for (const Finding& f : findings) {
    std::string topic = f.topic;
    topic.resize(std::max(kTopic, topic.size() + 1), ' ');
    out += std::string(mark(f.level)) + "  " + topic + indented(f.text, kText) + "\n";
    if (!f.todo.empty())
      out += std::string(kText, ' ') + "-> " + indented(f.todo, kText + 3) + "\n";
  }
  return out;
}

std::string to_json(const Findings& findings) {
  auto json = nlohmann::ordered_json::array();
  for (const Finding& f : findings)
    json.push_back(
        {{"level", name(f.level)}, {"topic", f.topic}, {"text", f.text}, {"todo", f.todo}});
  return json.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
}

std::string verdict(const Findings& findings, bool force_device) {
  const FindingLevel level = worst(findings);
  if (level == FindingLevel::kBad) return "Not ready: fix what is marked BAD first.";
  if (!force_device)
    return "Ready for mouse and gamepad. No force-feedback device was found or chosen.";
  return level == FindingLevel::kGood
             ? "Ready: the device gives force and this computer is fast enough."
             : "Ready. The notes say what could be improved.";
}

}  // namespace osteon
