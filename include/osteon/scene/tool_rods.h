#pragma once

#include <vector>

#include "osteon/collide/capsule_contact.h"
#include "osteon/scene/tool.h"

namespace osteon {

/// The whole tool as rods and balls, in Tool: what meets soft parts. A box counts
/// as the rod along its longest side, as thick as the mean of the others.
std::vector<Capsule> tool_rods(const Tool& tool);

}  // namespace osteon
