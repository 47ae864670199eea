#pragma once

#include "osteon/collide/field_view.h"
#include "osteon/collide/primitive_contact.h"

namespace osteon {

/// Lowest point of a box over a field, in the field's frame.
struct BoxLowest {
  Vec3 p = Vec3::Zero();
  FieldSample field;
};

/// The box's middle and axes are X_AB, `half` its half sides. Searched to 1e-7 m where the field is
/// smooth there; a height above `far_m` may be a bound below the true one. `places`: as
/// primitive_contact has them. Allocates nothing.
BoxLowest lowest_of_box(const FieldView& field, const Pose& X_AB, const Vec3& half, double far_m,
                        LowPlaces* places = nullptr);

}  // namespace osteon
