#pragma once

#include <cstdint>

namespace osteon {

/// What the window may change while a session runs. Takes effect at the edge of a haptic tick and
/// is recorded with it.
enum class CommandKind : std::uint32_t {
  kNone = 0,
  kSetStiffness = 1,      ///< value: N/m
  kSetFrictionScale = 2,  ///< value: factor on every material's friction
  kHoldBones = 3,         ///< value: 1 held rigidly, 0 held by springs
  kForceOff = 4,          ///< value: 1 off, 0 on
  /// value: N/m; the hand drags what it holds from where it is now, against a spring of this
  /// stiffness, and touches nothing meanwhile. 0: it lets go
  kGrab = 5,
};

/// The last of them.
inline constexpr CommandKind kLastCommandKind = CommandKind::kGrab;

struct Command {
  CommandKind kind = CommandKind::kNone;
  double value = 0;
};

}  // namespace osteon
