#pragma once

#include <limits>

#include "osteon/collide/capsule_contact.h"
#include "osteon/collide/field_view.h"
#include "osteon/collide/round_box.h"

namespace osteon {

/// Contact of a bone felt as a distance field with a capsule, as capsule_contact has it for a hull:
/// `nhat_AB_A` is the field's gradient at the axis' lowest point, p_A the surface below it. The gap
/// is continuous in the capsule's place, and where one point of the axis is lowest so is the
/// normal. Beyond the field's band the gap is a bound (the surface is at least so far). Allocates
/// nothing. Not finite: kNumerical. A gap above `far_m` may be told as a bound below it, which is
/// quicker.
CapsuleContact field_contact(const FieldView& field, const Capsule& capsule_A,
                             double far_m = std::numeric_limits<double>::infinity());

/// The same of a box with round edges; of a ball or rod it is that of its capsule. `p_axis_A` lies
/// on the box's core.
CapsuleContact round_contact(const FieldView& field, const RoundBox& box_A,
                             double far_m = std::numeric_limits<double>::infinity());

}  // namespace osteon
