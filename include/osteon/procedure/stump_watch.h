#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "osteon/procedure/scope_watch.h"
#include "osteon/scene/case.h"
#include "osteon/scene/event.h"
#include "osteon/scene/state.h"

namespace osteon {

// Made by who watches stumps being cleared; the session makes none of these.
/// So much of what torn ligaments have left is gone: {%; of the whole the % that went while no
/// scope saw the tip of an instrument in another portal, or the water hid everything; 0}. By whole
/// percents, and again every kTellStumps ticks, so that a stage that begins later knows.
inline constexpr EventKind kStumpsCleared{445};
inline constexpr std::uint64_t kTellStumps = 1000;

/// Follows stumps by what snapshots and tools say: a function of them, so that a replay finds the
/// same. The hand of an event is the first.
class StumpWatch {
 public:
  /// `optics`: by hand; none: nobody looks through it. The case must outlive it.
  StumpWatch(const Case& the_case, std::vector<std::optional<ScopeOptics>> optics);
  /// `obscured`: the water hides everything.
  void add(std::span<const ToolState* const> tools, const BoneSnapshot& bones, bool obscured,
           std::vector<Event>& out);
  /// None: no stumps are felt.
  std::optional<int> percent() const {
    return felt_ ? std::optional<int>(told_percent_) : std::nullopt;
  }
  /// Whether a scope has the tip of what is in another portal in its picture; none: nothing is.
  std::optional<bool> is_tip_watched(std::span<const ToolState* const> tools,
                                     const BoneSnapshot& bones) const;

 private:
  const Case* case_;
  std::vector<std::optional<ScopeOptics>> optics_;
  bool felt_ = false;
  int told_percent_ = 0;
  double cleared_percent_ = 0, blind_percent_ = 0;
};

}  // namespace osteon
