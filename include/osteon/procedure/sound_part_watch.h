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
/// A ligament or meniscus that is felt has lost something to an instrument: {mm3 that are gone of
/// it; % of its strands; the one of both that counts, as it was when it was last told}. By whole
/// mm3 or percents; the hand of an event is the first. Less than was told, after a restore point,
/// is no event.
inline constexpr EventKind kSoundPartLost{473};

/// Follows the tips of instruments that clear, and what sound parts have lost, by what tools and
/// snapshots say: a function of them, so that a replay finds the same.
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
  bool is_sound(SubjectKind kind, std::uint32_t soft) const;
  void tell_losses(std::uint64_t tick, const BoneSnapshot& bones, std::vector<Event>& out);

  const Case* case_;
  std::vector<char> clears_;
  double tick_s_;
  std::map<std::pair<std::size_t, std::uint32_t>, Visit> visits_;  ///< by hand and part
  std::map<std::uint32_t, double> lost_;                           ///< by part, as it was told
};

}  // namespace osteon
