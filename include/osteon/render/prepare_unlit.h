#pragma once

#include <cstddef>

#include "osteon/render/prepare.h"

namespace osteon {

/// One surface of prepare_unlit: all of them may be made at the same time, on threads of their own.
ShadedMesh unlit_bone(const Case& the_case, std::size_t bone);
/// The same of a soft part: hidden at first, it has no coarser levels yet.
ShadedMesh unlit_soft(const Case& the_case, std::size_t soft);

}  // namespace osteon
