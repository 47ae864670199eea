#pragma once

#include <vector>

#include "osteon/collide/capsule_contact.h"
#include "osteon/collide/round_box.h"
#include "osteon/scene/tool.h"

namespace osteon {

/// The whole tool as rods and balls, in Tool. A box counts as the rod along its longest side, as
/// thick as the mean of the others.
std::vector<Capsule> tool_rods(const Tool& tool);

/// The same parts in the same order, boxes as they are but for round edges: what meets skin and the
/// tools of other hands.
std::vector<RoundBox> tool_shapes(const Tool& tool);

/// The same as they meet ligaments and menisci. Of a tool that cuts, boxes count as rods: how hard
/// an edge is to be pressed before it goes in is told of those.
std::vector<RoundBox> soft_shapes(const Tool& tool);

}  // namespace osteon
