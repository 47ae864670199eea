#pragma once

#include <functional>

#include "osteon/mesh/distance.h"
#include "soft/soft_patch.h"

namespace osteon {

/// Draws the rim of `patch`, cut from `whole`, into smooth curves on the surface that `whole`
/// covers vertex by vertex; the vertices beside it follow. No vertex leaves its place by more than
/// 0.6 of the mean edge of the rim, none of the rim where `stays` moves at all, and no triangle
/// turns over. Normals and `inside` of what may have moved are those of `whole` at the new places.
void even_rim(const MeshDistance& surface, const CoveredPatch& whole,
              const std::function<bool(const Vec3&)>& stays, CoveredPatch& patch);

}  // namespace osteon
