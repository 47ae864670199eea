#pragma once

#include "osteon/base/types.h"

namespace osteon {

/// The least rotation that takes the direction of `from` to that of `to`; their lengths, more than
/// 0, do not matter. For opposite directions it is a half turn about an axis across them.
/// (Eigen's FromTwoVectors, compiled in one place: each file that calls it pays seconds for a
/// singular value decomposition that only opposite directions need.)
Quat turn_between(const Vec3& from, const Vec3& to);

}  // namespace osteon
