#pragma once

#include <array>
#include <cstdint>
#include <limits>

#include "osteon/collide/field_view.h"
#include "osteon/collide/lp_contact.h"
#include "osteon/collide/primitive.h"

namespace osteon {

/// Contact of a body A with a primitive B, in A.
struct PrimitiveContact {
  LpStatus status = LpStatus::kNumerical;  ///< kOptimal: the rest may be used
  /// Signed gap along `nhat_AB_A`, m. Apart it is the distance of the two (of a box and a convex
  /// body: at most the distance); overlapping, moving B by -gap along nhat parts them.
  double gap = 0;
  Vec3 nhat_AB_A = Vec3::UnitZ();  ///< unit, from A to B, in A
  Vec3 p_A = Vec3::Zero();         ///< a point of A where the two are nearest
  double top_A = 0;                ///< largest nhat_AB_A.x over A (of a field: at p_A), m
};

/// The lowest places of a box over a field, found with the box elsewhere. With the box moved by no
/// more than kNearby_m, a search may look about these alone: where bone has another place as low,
/// it misses that by no more than 2.5 times what the box was moved by.
struct LowPlaces {
  static constexpr double kNearby_m = 1e-4;
  Pose X_AB;                  ///< of the box that was searched as a whole
  std::array<Vec3, 4> p_B;    ///< in the box's frame, apart from each other
  std::uint32_t count = 0;    ///< 0: nothing is known yet
  bool looked_about = false;  ///< by the last search: it looked about these places alone
};

/// `basis`: of a box see lp_depth, of a rod capsule_contact. Allocates nothing, as those below.
PrimitiveContact primitive_contact(const ConvexBody& a, const Primitive& b, const Pose& X_AB,
                                   LpBasis* basis = nullptr);

/// A gap above `far_m` may be told as a bound below the true one, which is quicker. Beyond the
/// field's band it is a bound in any case. `places`: of a box, used and brought up to date; null:
/// the whole box is searched.
PrimitiveContact primitive_contact(const FieldView& a, const Primitive& b, const Pose& X_AB,
                                   double far_m = std::numeric_limits<double>::infinity(),
                                   LowPlaces* places = nullptr);

/// Both exact: the distance apart; overlapping, the shortest way that parts them, but for a rod
/// whose axis lies in a box: there it is that of the box's facets and the axis (capsule_contact).
PrimitiveContact primitive_contact(const Primitive& a, const Primitive& b, const Pose& X_AB);

}  // namespace osteon
