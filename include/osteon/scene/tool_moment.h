#pragma once

#include <span>

#include "osteon/base/types.h"
#include "osteon/scene/portal.h"
#include "osteon/scene/state.h"
#include "osteon/scene/tool.h"

namespace osteon {

/// Where a hand holds a tool, in Tool: at the end of its shaft, where the handle begins. What has
/// no shaft is held at its tip.
Vec3 grip_of(const Tool& tool);

/// The moment of all that acts on the tool about the point `p_W`, N m, in World: of bones and other
/// tools where they touch it, of a portal at its hole. A function of the state, which `portals`
/// must be those of. Zero while the force only fades; not finite where the state is not.
Vec3 moment_about(const Vec3& p_W, const ToolState& state, std::span<const Portal> portals);

/// The moment of all that acts on the tool about the hand's grip, N m, in World: of bones and other
/// tools where they touch it, of a portal at its hole. By it and the force (ToolState::force_W) the
/// hand is told all that the tool feels. A function of the state, which `tool` and `portals` must
/// be those of. Zero while the force only fades, and where anything is not finite.
Vec3 moment_at_grip(const ToolState& state, const Tool& tool, std::span<const Portal> portals);

}  // namespace osteon
