#pragma once

#include "osteon/base/types.h"
#include "osteon/collide/primitive_contact.h"
#include "osteon/scene/tool_guide.h"

namespace osteon {

/// A line that leads an instrument: its tip stays on it, its axis lies in it, and a hand beside it
/// feels the spring of its coupling across the line.
///
/// Symbols: e, from the line to the hand, across it; k, the coupling; g, how far a pin gives way by
/// a newton. Both springs share e: f = e / (1/k + g), the pin bends by g f, and at most by
/// kMostBend_m: beyond, f = k (e - kMostBend_m). f rises with e by at most k a metre: the bound of
/// the coupling's own spring (HapticParams) holds for it. What pulls holds by the same spring along
/// the line, beyond its place.
struct GuidePull {
  bool in = false;
  Vec3 line_W = Vec3::Zero();  ///< a place on the line as the pin is bent
  Vec3 along_W = Vec3::UnitZ();
  Vec3 p_W = Vec3::Zero();      ///< where the hand's pull leaves the tool's origin
  Quat q_W = Quat::Identity();  ///< and how it leaves it turned
  Vec3 force_W = Vec3::Zero();  ///< on the hand, N, across the line, and along one that pulls
};

struct GuideHand {
  Pose X_WD;
  Vec3 v_W = Vec3::Zero();
  double stiffness_n_per_m = 0, damping_n_s_per_m = 0;  ///< of the coupling
};

/// The most that a pin bends aside, m: farther it would not stay in the bone. Own default.
inline constexpr double kMostBend_m = 0.001;

/// `bone_v_W`: of the bone, where the line is.
GuidePull pull_of(const ToolGuide& guide, const Pose& X_WB, const Vec3& bone_v_W,
                  const GuideHand& hand);

/// What an instrument in its hole meets of the bone, whichever part of it is asked about: the
/// hole's end, a plane across the line at which its origin stops, or nothing within `far_m`. How
/// far that part and the whole tool reach from the origin against the plane's normal: `part_m`,
/// `tool_m`.
PrimitiveContact hole_end(const ToolGuide& guide, const Pose& X_BT, double part_m, double tool_m,
                          double far_m);

}  // namespace osteon
