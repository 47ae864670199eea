#pragma once

#include <cstddef>

#include "osteon/base/id.h"
#include "osteon/mesh/tri_mesh.h"
#include "osteon/scene/case.h"

namespace osteon {

/// Draws another surface for a soft part of the painter's case from now on, in World with the
/// bones at rest: of one that gives way. As Renderer::set_surface does for a bone.
/// `Painter`: Renderer or ScopeRenderer.
template <class Painter>
void set_soft_surface(Painter& painter, const Case& the_case, std::size_t soft,
                      const TriMesh& mesh_W) {
  painter.set_surface(BoneId{static_cast<std::uint32_t>(the_case.bones.size() + soft)}, mesh_W);
}

}  // namespace osteon
