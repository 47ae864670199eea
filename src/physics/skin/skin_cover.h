#pragma once

#include "osteon/physics/skin_setup.h"
#include "osteon/scene/case.h"

namespace osteon {

/// What yields under a patch: at each node of the relief's grid how far it is straight down to bone
/// or tendon, `most_m` where that is farther. Over an edge the nodes share what the fat beside them
/// bears. `X_WS`: of the sheet, over bones at rest.
SkinRelief cover_of(const Case& the_case, const Pose& X_WS, const SkinRelief& relief,
                    double most_m);

}  // namespace osteon
