#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "osteon/base/result.h"
#include "osteon/mesh/tri_mesh.h"
#include "osteon/render/scope_camera.h"
#include "osteon/scene/instrument.h"
#include "osteon/scene/scope.h"
#include "osteon/scene/state.h"

namespace osteon {

/// Of each instrument of a tray, by its place: what is seen through it; none: nobody looks through
/// it.
using Lenses = std::vector<std::optional<ScopeDef>>;

/// `tray`: names as make_tray takes them. Fails where the files of instruments or scopes cannot be
/// read.
Result<Lenses> lenses_of(const std::vector<std::string>& tray);
/// The same of instruments that have been read.
Result<Lenses> lenses_of(const std::vector<std::string>& tray,
                         std::span<const Instrument> instruments);

/// What is seen through a tool now; null: nothing.
const ScopeDef* lens_of_tool(const Lenses& lenses, const ToolState& tool);
/// The first of these tools that is looked through.
std::optional<std::size_t> first_looking(const Lenses& lenses, std::span<const ToolState> tools);

/// The camera turns with the shaft; upwards in the picture is the side that the lens looks to.
ScopePose scope_pose(const Pose& X_WT);

/// Where a scope looks: a closed cone of 30 mm, its top at the lens, as wide as its field in water.
TriMesh sight_cone(const Pose& X_WT, const ScopeDef& scope);

}  // namespace osteon
