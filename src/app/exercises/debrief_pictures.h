#pragma once

#include <array>
#include <span>
#include <vector>

#include "exercises/debrief.h"
#include "osteon/base/result.h"
#include "osteon/mesh/tri_mesh.h"
#include "osteon/render/prepare.h"
#include "osteon/render/renderer.h"

namespace osteon {

/// The ways of tips as tubes over a scene: a colour for each hand, the expert's in blue.
std::vector<SolidMark> way_marks(const Debrief& debrief);
/// A tube of this radius along a line, closed at its ends; steps shorter than half the radius are
/// left out. Empty: fewer than two places are apart.
TriMesh tube_along(std::span<const Vec3> line_W, double radius_m, int sides);

/// Colours surfaces by a map: afterwards ViewState::show_felt shows it, orange where it is full.
void color_by_damage(const DamageMap& map, DamageKind kind, PreparedCase& prepared);

/// The same as beads on the surfaces at rest, in a few steps from pale to orange.
std::vector<SolidMark> damage_marks(const Debrief& debrief, DamageKind kind);

/// Looks at what bears damage of that kind, from where it was done.
Camera camera_at_damage(const Debrief& debrief, DamageKind kind, double aspect);

/// Pictures for the pages: the ways, and of each kind of damage that would be seen a map. Fails
/// where nothing can be drawn (no OpenGL). The first needs a current context, the second makes one.
Result<std::vector<DebriefPicture>> draw_debrief_here(const Debrief& debrief);
Result<std::vector<DebriefPicture>> draw_debrief(const Debrief& debrief);

}  // namespace osteon
