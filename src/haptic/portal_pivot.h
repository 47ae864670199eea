#pragma once

#include <cstdint>
#include <span>

#include "nearest_point.h"
#include "osteon/base/types.h"
#include "osteon/collide/capsule_contact.h"
#include "osteon/scene/portal.h"

namespace osteon {

/// A shaft through a hole in the skin: it pivots there, the skin yields a little sideways and rubs
/// along it, and it cannot leave sideways.
///
/// Symbols: e, from the shaft's axis to the portal across the axis, with the tool where the hand
/// wants it; L, from the tool's origin to the axis beside the portal. Three springs in a row share
/// e: the coupling k (the origin gives way by t), a turn of the shaft about its origin (the hand
/// lets a shaft swing: its stiffness is k L0^2), and the skin k_s, which gives at most
/// kMostYield_m. So one force acts in all, f = e / (1/k_s + 1/k + L^2 / (k L0^2)), and once the
/// skin gives no more f = (e - most) / (1/k + L^2 / (k L0^2)). f is the slope of a potential of the
/// hand's place that is convex, and it rises by at most k a metre: the bound of the coupling's own
/// spring (HapticParams) holds for it with the coupling's damper.
struct PortalPivot {
  bool in = false;
  Vec3 p_W = Vec3::Zero();       ///< where the hand's pull leaves the tool's origin
  Quat q_W = Quat::Identity();   ///< and how it leaves it turned
  Vec3 force_W = Vec3::Zero();   ///< on the hand, N: sideways and along
  Vec3 along_W = Vec3::UnitZ();  ///< of the shaft, from tip to handle
};

struct PortalHand {
  Pose X_WD;
  Vec3 v_W = Vec3::Zero();
  double stiffness_n_per_m = 0;  ///< of the coupling
  double damping_n_s_per_m = 0;
  double friction_scale = 1;
};

/// How far the skin yields sideways, m.
inline constexpr double kMostYield_m = 0.0008;

/// Enters a portal where the tip passes the skin within 5 mm of it, or is within already while
/// `start`; leaves it where the tip is withdrawn and the hand, at X_WD, has it out as well (or 5 mm
/// out): at the rim the pivot itself may lift the tip out of the skin. Of one that has been let go
/// `grip` tells how much longer it counts as in, from 1 to 0: the skin may push a yielding hand
/// out, and it comes in again, many times a second. One that was made in a patch of skin is entered
/// where the patch lets the shaft through: `let_in`, in `portals`; PortalHold::kNone: nowhere.
/// `shaft` in Tool, p0 at the tip.
void follow_portals(std::span<const Portal> portals, const Capsule& shaft, const Pose& X_WP,
                    const Pose& X_WD, bool start, std::uint32_t let_in, PortalHold& hold);

/// What the portal that `hold` names does with the hand; moves `hold`'s friction on.
PortalPivot pivot_in(std::span<const Portal> portals, const Capsule& shaft, const PortalHand& hand,
                     PortalHold& hold);

/// q turned about the tool's origin at p_W so that the shaft passes the portal within the skin's
/// yield.
Quat through_portal(const Portal& portal, const Capsule& shaft, const Vec3& p_W, const Quat& q_W);

/// What keeps a shaft from leaving its portal, or a line that leads it, sideways, whatever bone
/// does to its tip: where its origin may be for a turn, an octagon across the axis.
struct PortalRing {
  static constexpr std::uint32_t kPlanes = 8;
  Vec3 p_W = Vec3::Zero();  ///< where the axis passes
  Capsule shaft;            ///< in Tool
  double radius_m = 0;      ///< of the circle in the octagon
  void raise(const Quat& q_WT, std::span<FreeHalfSpace> out) const;
};

/// For a shaft that is at X_WT: the skin's yield, or where it came in askew no more than it is off.
PortalRing ring_of(const Portal& portal, const Capsule& shaft, const Pose& X_WT);

/// What keeps a tool's origin on a line that its axis lies in: within 20 um of it, or no farther
/// than it is off already. `p_W`: a place on the line; `along_W`: unit.
PortalRing ring_about_line(const Vec3& p_W, const Vec3& along_W, const Pose& X_WT);

/// How far the shaft's axis passes from the portal, across the axis, m.
double off_portal(const Portal& portal, const Capsule& shaft, const Pose& X_WT);

}  // namespace osteon
