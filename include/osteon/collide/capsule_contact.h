#pragma once

#include <cstddef>

#include "osteon/base/types.h"
#include "osteon/collide/convex_body.h"
#include "osteon/collide/lp_contact.h"

namespace osteon {

/// All points within `radius` of the segment from p0 to p1. Equal ends: a ball; radius 0: a point
/// or a thin rod.
struct Capsule {
  Vec3 p0 = Vec3::Zero(), p1 = Vec3::Zero();
  double radius = 0;  ///< m
};

/// Contact of a hull A with a capsule.
struct CapsuleContact {
  LpStatus status = LpStatus::kNumerical;  ///< kOptimal: the rest may be used
  /// Signed gap between the surfaces, m. While the axis is outside of A it is the distance less the
  /// radius; an axis inside counts as the overlap along `nhat_AB_A`, which parts the two.
  double gap = 0;
  Vec3 nhat_AB_A = Vec3::UnitZ();  ///< unit, from A to the capsule, in A
  Vec3 p_A = Vec3::Zero();         ///< of A: nearest to the axis; inside, the axis' deepest point
  Vec3 p_axis_A = Vec3::Zero();    ///< of the axis: nearest to A or deepest in it
  int steps = 0;
};

/// `capsule_A` in A's frame. Outside: the distance of the axis by Gilbert, Johnson and Keerthi
/// (1988). Inside: minimise t subject to n_i.x - t <= d_i for x on the axis, the depth programme
/// with one degree of freedom left, by its dual simplex method. Allocates nothing. `basis` keeps
/// what carried the nearest point: while the two move little, the next search is a step or two. A
/// stale one costs time alone.
CapsuleContact capsule_contact(const ConvexBody& a, const Capsule& capsule_A,
                               LpBasis* basis = nullptr);

}  // namespace osteon
