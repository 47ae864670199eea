#pragma once

#include <array>
#include <span>
#include <vector>

#include "osteon/scene/event.h"
#include "osteon/scene/state.h"

namespace osteon {

/// A blade has come out of skin that is there for no portal: {how much of such skin is open now,
/// mm; the farthest that the blade was beside the middle of the patch, across the limb, mm; how far
/// it was beyond the fat, mm}. Made by who watches; the session makes none.
inline constexpr EventKind kSkinOpened{474};

/// Follows blades in skin by what snapshots say: a function of them, so that a replay finds the
/// same.
class SkinWatch {
 public:
  void add(std::span<const ToolState* const> tools, const BoneSnapshot& bones,
           std::vector<Event>& out);

 private:
  std::array<SkinBlade, kMaxHands> strokes_{};  ///< of each hand that cuts: its worst so far
};

}  // namespace osteon
