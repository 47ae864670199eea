#include "exercises/attempt_pause.h"

#include <charconv>

namespace osteon {
namespace {

bool take_number(std::string_view& text, char after, std::uint64_t& number) {
  const auto [end, ec] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (ec != std::errc() || end == text.data() + text.size() || *end != after) return false;
  text.remove_prefix(static_cast<std::size_t>(end - text.data()) + 1);
  return true;
}

}  // namespace

PausedTick paused_at(std::span<const AttemptPause> pauses, std::uint64_t tick) {
  PausedTick at;
  for (const AttemptPause& pause : pauses) {
    if (tick < pause.from) break;
    if (tick < pause.to) return {true, at.before};
    at.before += pause.to - pause.from;
  }
  return at;
}

std::string to_text(std::span<const AttemptPause> pauses) {
  std::string text;
  for (const AttemptPause& pause : pauses)
    text += std::to_string(pause.from) + " " + std::to_string(pause.to) + "\n";
  return text;
}

Result<std::vector<AttemptPause>> parse_pauses(std::string_view text, const std::string& where) {
  std::vector<AttemptPause> pauses;
  std::uint64_t last = 0;
  while (!text.empty()) {
    AttemptPause pause;
    if (!take_number(text, ' ', pause.from) || !take_number(text, '\n', pause.to) ||
        pause.from < last || pause.to < pause.from)
      return fail("its list of pauses is damaged", where, "Use another copy of the file");
    last = pause.to;
    pauses.push_back(pause);
  }
  return pauses;
}

}  // namespace osteon
