#pragma once

#include "osteon/scene/tool.h"

namespace osteon {

/// Where the axis of a tool's shaft begins, in Tool: of a hook it lies beside the tip.
Vec3 shaft_beside_tip(const Tool& tool);

/// A tool whose shaft points along the way into a portal, its axis through the portal's place, the
/// tip `before_m` before it. `inwards_W`: unit.
Pose before_portal(const Tool& tool, const Vec3& p_W, const Vec3& inwards_W, double before_m);

/// Where the tool `now` has its shaft on the line on which `before` had it at `X_WT`.
Pose on_the_same_line(const Tool& before, const Tool& now, const Pose& X_WT);

}  // namespace osteon
