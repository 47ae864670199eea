#pragma once

#include <cstddef>
#include <span>

#include "osteon/base/id.h"
#include "osteon/mesh/tri_mesh.h"
#include "osteon/scene/case.h"

namespace osteon {

/// Draws another surface for a soft part of the painter's case from now on, in World with the
/// bones at rest: of one that gives way, or was cut open, as Renderer::move_surface does.
/// `Painter`: Renderer or ScopeRenderer.
template <class Painter>
void set_soft_surface(Painter& painter, const Case& the_case, std::size_t soft,
                      const TriMesh& mesh_W, std::span<const float> depth_m = {}) {
  painter.move_surface(BoneId{static_cast<std::uint32_t>(the_case.bones.size() + soft)},
                       the_case.softs[soft].mesh_W, mesh_W, depth_m);
}

}  // namespace osteon
