#pragma once

#include <cstddef>

#include "osteon/scene/state.h"

namespace osteon {

/// What can be reckoned with: finite, not absurdly far away, and turns of about unit length. A
/// broken reading or a broken snapshot fails, and the tick gives no force.
bool usable(const Pose& X);
bool usable(const ToolInput& input);
/// Of the first `count` bones.
bool usable(const BoneSnapshot& bones, std::size_t count);

}  // namespace osteon
