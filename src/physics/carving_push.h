#pragma once

#include <cstdint>

#include "osteon/physics/carving.h"

namespace osteon {

/// How a tool stands on a bone in one step.
struct Carving::Push {
  const ToolState* tool = nullptr;
  std::uint32_t bone = CarvingHand::kNoBone;  ///< that it presses most; kNoBone: it touches none
  Pose X_WB, X_BT;
  Vec3 force_B = Vec3::Zero();  ///< on the tool
  Vec3 at_B = Vec3::Zero();     ///< where it presses: the mean over its contacts, by their force
  std::uint64_t tick = 0;       ///< of the first hand
};

namespace carving {

inline constexpr double kSkin_m = 5e-6;  ///< that a proxy keeps from a field
inline constexpr double kStep_s = 0.002;
inline constexpr std::uint32_t kRestSteps = 50;  ///< without a cut: it has stopped

inline Pose moved_along(const Pose& X, const Vec3& way) { return {X.p + way, X.q}; }
inline Vec3 back_of(const Pose& X) { return X.q * Vec3::UnitZ(); }
inline bool goes_forward(CarvingTool::Way way) {
  using Way = CarvingTool::Way;
  return way == Way::kDrill || way == Way::kTwist || way == Way::kStrike;
}

}  // namespace carving
}  // namespace osteon
