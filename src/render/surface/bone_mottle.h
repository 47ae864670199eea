#pragma once

#include <cstddef>

#include "osteon/base/types.h"

namespace osteon {

/// How a bone's colour varies over it, 0..1: patches of 9 mm with finer ones of 2.5 mm in them; no
/// bone has the pattern of another.
double bone_mottle(const Vec3& p_B, std::size_t bone);

}  // namespace osteon
