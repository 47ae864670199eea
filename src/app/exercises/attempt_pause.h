#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "osteon/base/result.h"

namespace osteon {

/// Ticks of a recorded attempt in which it was interrupted, the first and the one after the last.
struct AttemptPause {
  static constexpr std::uint64_t kOpen = std::numeric_limits<std::uint64_t>::max();
  std::uint64_t from = 0, to = kOpen;
  bool operator==(const AttemptPause&) const = default;
};

struct PausedTick {
  bool in_pause = false;
  std::uint64_t before = 0;  ///< ticks of the pauses before it
};
/// `pauses` in their order, none over another.
PausedTick paused_at(std::span<const AttemptPause> pauses, std::uint64_t tick);

/// As a recording's note: "1200 3400" a line.
std::string to_text(std::span<const AttemptPause> pauses);
/// Fails on what is not such a text, and on pauses that are not one after the other.
Result<std::vector<AttemptPause>> parse_pauses(std::string_view text, const std::string& where);

}  // namespace osteon
