#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <utility>
#include <vector>

#include "osteon/scene/case.h"
#include "osteon/scene/event.h"
#include "osteon/scene/state.h"

namespace osteon {

// Made by who watches what clears; the session makes none of these.
/// What clears soft tissue runs while its tip is in a ligament or meniscus that cannot be felt, and
/// so cannot be cleared: {s, since the tip went in; deepest, mm; 0}, of the soft part. Every
/// kTellSoundPart ticks of that.
inline constexpr EventKind kSoundPartCleared{472};
inline constexpr std::uint64_t kTellSoundPart = 50;

/// Follows the tips of instruments that clear, by what tools and snapshots say: a function of them,
/// so that a replay finds the same.
class SoundPartWatch {
 public:
  /// `clears`: by place in the tray. The case must outlive it.
  SoundPartWatch(const Case& the_case, std::vector<char> clears, double tick_s)
      : case_(&the_case), clears_(std::move(clears)), tick_s_(tick_s) {}
  void add(std::span<const ToolState* const> tools, const BoneSnapshot& bones,
           std::vector<Event>& out);

 private:
  struct Visit {
    std::uint64_t first_step = 0, ticks = 0;
  };
  bool is_sound(const Inside& inside) const;

  const Case* case_;
  std::vector<char> clears_;
  double tick_s_;
  std::map<std::pair<std::size_t, std::uint32_t>, Visit> visits_;  ///< by hand and part
};

}  // namespace osteon
