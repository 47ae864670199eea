#pragma once

#include <cmath>
#include <optional>

#include "osteon/render/renderer.h"
#include "osteon/scene/state.h"

namespace osteon {

inline Aabb finite_bounds(const TriMesh& mesh) {
  Aabb box;
  for (const Vec3& p : mesh.vertices)
    if (is_finite(p)) box.include(p);
  return box;
}

struct ForceArrow {
  Vec3 from_W = Vec3::Zero(), dir_W = Vec3::UnitZ();
  double length_m = 0;
};

/// The force on the hand, from the place where the probe touches.
inline std::optional<ForceArrow> force_arrow(const ToolState& tool) {
  constexpr double kSmallestForce_N = 0.02;
  const double force = tool.force_W.norm();
  if (!std::isfinite(force) || force < kSmallestForce_N) return std::nullopt;
  ForceArrow arrow{tool.X_WP.p, tool.force_W / force, force * kForceArrowMetresPerNewton};
  if (tool.contact_count > 0 && is_finite(tool.contacts[0].p_W))
    arrow.from_W = tool.contacts[0].p_W;
  return is_finite(arrow.from_W) ? std::optional(arrow) : std::nullopt;
}

}  // namespace osteon
