#pragma once

#include <cstddef>
#include <span>

#include "osteon/scene/state.h"

namespace osteon {

/// How a soft part has moved in World with its bones: the mean of their motions away from rest,
/// about its centre at rest. Bones that the snapshot does not have are left out; without any it has
/// not moved.
Pose mean_motion(const BoneSnapshot& bones, std::span<const Pose> rest_X_WB,
                 std::span<const std::size_t> rides_on, const Vec3& center_W);

}  // namespace osteon
