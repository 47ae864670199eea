#pragma once

#include "way_draft.h"

namespace osteon {

/// From each loose ring of the case to a mark of the goal: round it, up, over, down, and open.
void plan_rings(const PlannedRule& goal, const Case& the_case, WayDraft& draft);

}  // namespace osteon
