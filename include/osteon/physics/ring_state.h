#pragma once

#include <array>
#include <cstdint>

#include "osteon/base/types.h"
#include "osteon/scene/event.h"
#include "osteon/scene/rings.h"
#include "osteon/scene/state.h"

namespace osteon {

/// One loose ring.
struct LooseRing {
  enum class Is : std::uint8_t { kResting = 0, kHeld = 1, kFalling = 2 };
  Is is = Is::kResting;
  Pose X_WB;
  std::uint8_t hand = kNoHand;    ///< whose jaws it moves with
  std::uint8_t second = kNoHand;  ///< whose jaws are shut about it too
  Pose X_PB;                      ///< in the tool of `hand`, while it is held
  double falls_m_per_s = 0;
};

/// All that a step of the rings leaves to the next: of fixed size.
struct RingsState {
  bool on = false;  ///< the case has rings
  std::uint32_t count = 0;
  std::array<LooseRing, kMaxRings> rings{};
  std::array<bool, kMaxHands> shut{};  ///< by hand: its jaws were, at the last step
  std::array<std::uint32_t, kMaxHands> instrument{};
};

}  // namespace osteon
