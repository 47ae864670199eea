#pragma once

#include "osteon/scene/build_case.h"

namespace osteon {

/// Soft parts look as their tissues do; one that the table lacks keeps its plain colour.
void colour_softs(CaseDef& def);

}  // namespace osteon
