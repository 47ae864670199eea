#pragma once

#include <array>
#include <cstdint>

#include "osteon/base/types.h"

namespace osteon {

/// What stands beside or in a bone and leads instruments along its own line.
struct GuideRod {
  enum class Kind : std::uint8_t {
    kNone,
    kPin,    ///< drilled in and let go: it leads what is hollow over itself
    kSleeve  ///< of an aimer that was fixed: it leads what is thin through itself
  };
  Kind kind = Kind::kNone;
  std::uint32_t bone = 0;
  Pose X_BR;             ///< in Bone: origin at the inner end, +z outwards
  double radius_m = 0;   ///< of the pin, or of the sleeve's bore
  double length_m = 0;   ///< up to the outer end
  double in_bone_m = 0;  ///< of a pin: so much of it holds in the bone
};
inline constexpr std::size_t kMaxGuideRods = 4;
using GuideRods = std::array<GuideRod, kMaxGuideRods>;

/// The line that leads a hand's instrument: that of a rod, or of the hole that it has begun. Its
/// tip stays on the line, its axis lies in it.
struct ToolGuide {
  bool on = false;
  std::uint32_t instrument = 0;  ///< in the session's tray: another one is not led
  std::uint32_t bone = 0;
  Vec3 p_B = Vec3::Zero();      ///< on the line
  Vec3 nhat_B = Vec3::UnitZ();  ///< unit, outwards
  double grip = 0;              ///< 0 to 1: how much of the hold there is yet
  double give_m_per_n = 0;      ///< sideways, of a pin that bends
  bool in_hole = false;         ///< that bone is felt as what the hole leaves of it
  bool stops = false;           ///< there is bone before the tip
  double stop_m = 0;            ///< the tip goes no farther, along nhat_B from p_B
  /// It hangs on something: beyond stop_m along nhat_B the hand feels the spring of its coupling.
  bool pulls = false;
};

}  // namespace osteon
