#pragma once

#include <limits>

#include "osteon/collide/capsule_contact.h"
#include "osteon/collide/field_view.h"

namespace osteon {

/// Contact of a carved bone with a rod, in the bone's frame, as field_contact has it, but measured
/// at the rod's surface: a rod that fills its hole, or stands over a narrower one, has walls on
/// several sides, and there a field's height in the middle tells too little. `coarse`: where the
/// nearest place is looked for (a wide field for a thick rod); `fine`: where it is measured. A gap
/// above `far_m` may be told as a bound below it, and one below `low_m` as that of any place of the
/// rod that is so low. Allocates nothing.
CapsuleContact carved_contact(const FieldView& coarse, const FieldView& fine, const Capsule& rod_A,
                              double far_m,
                              double low_m = -std::numeric_limits<double>::infinity());

}  // namespace osteon
