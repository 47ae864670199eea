#pragma once

#include <vector>

#include "osteon/scene/build_case.h"

namespace osteon {

/// The joints of a case, their bones found among `bones`. Fails with the joint's name when a bone
/// is not there, when a track holds no pose or one that is not finite, when tracks differ in their
/// range, or when the joint is bent beyond it.
Result<std::vector<CaseJoint>> build_joints(std::vector<JointDef> defs,
                                            const std::vector<Bone>& bones);

}  // namespace osteon
