#pragma once

#include <vector>

#include "osteon/anatomy/bone_gaps.h"
#include "osteon/anatomy/generate.h"
#include "osteon/mesh/distance.h"

namespace osteon {

/// bone_gaps of surfaces that are ready to be asked, the pairs run as `options` says.
std::vector<BoneGap> surface_gaps(const std::vector<const MeshDistance*>& surfaces, double reach_m,
                                  const GenerateOptions& options);

}  // namespace osteon
