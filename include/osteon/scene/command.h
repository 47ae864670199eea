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
  /// value: number of a restore point, 0 to kMaxMarks - 1; the session's state there is kept. Goes
  /// to every hand and to physics.
  kMark = 6,
  kRestore = 7,  ///< value: as kMark's; the session goes back to what was kept there
  kTake = 8,     ///< value: place in the session's tray of the instrument that the hand takes
  kPower = 9,    ///< value: 0 (off) to 1
  kJaw = 10,     ///< value: 0 (closed) to 1 (open)
  kFault = 11,   ///< value: why the safety gate took the force off (ForceOff); for the events alone
  kPump = 12,    ///< value: pressure of the pump that fills the joint, Pa
  kOutlet = 13,  ///< value: how far the joint's outlet is open, 0 to 1
  /// value: 0; a graft is about to be handed over, what was told of one before is forgotten
  kGraftOrder = 14,
  /// value: the next of placing_numbers, m or rad; with the last of them the graft is there
  kGraftNumber = 15,
  kBend = 16,     ///< value: how far the case's joint is to be bent, degrees
  kTension = 17,  ///< value: pull on the tail of a graft whose button has turned, N
  /// value: 0; how the knee gives is about to be told, what was told of that before is forgotten
  kKneeOrder = 18,
  kKneeNumber = 19,  ///< value: the next of give_numbers; with the last of them it can be examined
  kLachman = 20,     ///< value: pull on the tibia to the front, N; ends the other test
  kPivot = 21,       ///< value: share of the pivot shift's load, 0 to 1; ends the other test
  /// value 0: the patches of skin about portals are felt no more once each has one, which stays
  /// open and lets any shaft in as one of the case does; 1: no patch is felt any more
  kBareSkin = 22
};

/// The last of them.
inline constexpr CommandKind kLastCommandKind = CommandKind::kBareSkin;

/// Restore points of a session.
inline constexpr std::uint32_t kMaxMarks = 16;

struct Command {
  CommandKind kind = CommandKind::kNone;
  double value = 0;
};

/// Whether it concerns physics and no hand.
inline bool is_for_physics_alone(CommandKind kind) {
  return kind == CommandKind::kHoldBones || kind == CommandKind::kPump ||
         kind == CommandKind::kOutlet || kind == CommandKind::kGraftOrder ||
         kind == CommandKind::kGraftNumber || kind == CommandKind::kBend ||
         kind == CommandKind::kTension ||
         (kind >= CommandKind::kKneeOrder && kind <= CommandKind::kBareSkin);
}
/// Whether it concerns physics: such a command goes to physics, and to the hands as well unless
/// is_for_physics_alone.
inline bool is_for_physics(CommandKind kind) {
  return is_for_physics_alone(kind) || kind == CommandKind::kMark || kind == CommandKind::kRestore;
}
/// The number of the restore point that it names; kMaxMarks when it names none.
inline std::uint32_t mark_of(const Command& command) {
  const bool named = command.kind == CommandKind::kMark || command.kind == CommandKind::kRestore;
  const bool sound = named && command.value >= 0 && command.value < kMaxMarks;
  return sound ? static_cast<std::uint32_t>(command.value) : kMaxMarks;
}

}  // namespace osteon
