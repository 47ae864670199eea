#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "osteon/scene/event.h"
#include "osteon/scene/state.h"

namespace osteon {

// Made by who watches stumps being cleared; the session makes none of these.
/// So much of what torn ligaments have left is gone: {%; 0; 0}. By whole percents, and again every
/// kTellStumps ticks, so that a stage that begins later knows.
inline constexpr EventKind kStumpsCleared{445};
inline constexpr std::uint64_t kTellStumps = 1000;

/// Follows stumps by what snapshots say: a function of them, so that a replay finds the same. The
/// hand of an event is the first.
class StumpWatch {
 public:
  void add(std::uint64_t tick, const BoneSnapshot& bones, std::vector<Event>& out);
  /// None: no stumps are felt.
  std::optional<int> percent() const {
    return felt_ ? std::optional<int>(told_percent_) : std::nullopt;
  }

 private:
  bool felt_ = false;
  int told_percent_ = 0;
};

}  // namespace osteon
