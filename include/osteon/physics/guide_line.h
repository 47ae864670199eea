#pragma once

#include <optional>
#include <span>

#include "osteon/base/types.h"
#include "osteon/physics/carving.h"
#include "osteon/scene/state.h"
#include "osteon/scene/tool_guide.h"

namespace osteon {

/// Whether a rod leads an instrument along its own line: a pin what is hollow enough, a sleeve what
/// is thin enough.
bool rod_leads(const GuideRod& rod, const CarvingTool& with);

/// How an instrument that is held as `like_W` is held on the rod that leads it: its axis in the
/// rod's line, its tip at the same height over the rod's inner end, but on the rod and outside of
/// what a pin holds in. Of several rods the nearest. None: no rod leads it.
std::optional<Pose> held_on_rod(const GuideRods& rods, std::span<const BoneMotion> bones,
                                const CarvingTool& with, const Pose& like_W);

}  // namespace osteon
