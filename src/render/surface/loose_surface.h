#pragma once

#include <cstddef>

#include "osteon/render/renderer.h"

namespace osteon {

/// A piece of bone that was cut off, in the light of what lies free: its old surface looks as the
/// bone's did, what was inside like bone that is cut open.
ShadedMesh loose_shaded(const SurfaceCube& surface, std::size_t bone);

}  // namespace osteon
