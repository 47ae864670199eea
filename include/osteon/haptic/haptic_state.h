#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "osteon/base/id.h"
#include "osteon/collide/lp_contact.h"
#include "osteon/haptic/soft_rub.h"
#include "osteon/scene/portal.h"
#include "osteon/scene/state.h"

namespace osteon {

/// A plane that parts a piece of bone from a piece of the tool, in the bone's frame: it stays valid
/// when either moves, with the tool's new support.
struct PartingPlane {
  Vec3 nhat_BT_B = Vec3::UnitZ();  ///< unit, from bone to tool
  double bone_support = 0;         ///< largest n.b over the bone's piece, m
  double gap = 0;                  ///< at the pose where it was found, m
  Vec3 p_B = Vec3::Zero();         ///< between the two, where they are nearest
};

/// What is known of one pair of a bone's and a tool's piece.
struct PairMemory {
  static constexpr std::uint32_t kNone = 0xffffffffu;
  std::uint32_t pair = kNone;  ///< which one, of the loop's own list
  LpBasis basis;
  PartingPlane plane;
  bool known = false;  ///< `plane` is one
};

/// Everything that one haptic tick leaves to the next. A value: copy it to save, compare or rewind.
struct HapticState {
  ToolState tool;            ///< as the last tick returned it
  bool armed = false;        ///< the hand has been free of bone once since the start
  bool sliding = false;      ///< dynamic friction acts
  BoneId carrier;            ///< bone that the proxy rests on and moves with; none when free
  bool grabbing = false;     ///< the hand drags what it has grabbed
  Vec3 p_WG = Vec3::Zero();  ///< where the hand was when it did
  SoftRub rub;               ///< on soft parts
  PortalHold portal;         ///< the hole in the skin that the shaft passes through
  double fade_n = 0;    ///< by so much the force falls in a tick until it is zero; 0: none left
  OtherTools others{};  ///< of the other hands, as the last tick saw them
  std::uint32_t bone_count = 0;
  std::array<Pose, kMaxBones> X_WB{};  ///< bones as the last tick saw them
  std::vector<PairMemory> pairs;       ///< those that were near, in their order; then kNone
};

/// Of all that decides what the next ticks feel.
std::uint64_t hash_of(const HapticState& state);

}  // namespace osteon
