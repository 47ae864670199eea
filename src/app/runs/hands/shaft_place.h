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

/// A tool that is led by a hole: pushed along its shaft by so many notches of a wheel, 2 mm each
/// (below 0: deeper); once the tip is 3 mm inside, turned about it so that the axis of the shaft
/// leads back through the hole. `beside_T`: as shaft_beside_tip has it.
Pose slid_through(Pose X_WT, const Vec3& beside_T, const Vec3& hole_W, double wheel);

}  // namespace osteon
