#pragma once

#include <cstddef>
#include <utility>
#include <vector>

#include "bone/placed_bones.h"
#include "describe/description.h"
#include "osteon/anatomy/generate.h"
#include "osteon/base/pose_track.h"

namespace osteon {

/// How a joint moves its bones: for each, its motion away from rest in World (D_W: what was at p_W
/// comes to D_W * p_W), by degrees of bend.
using JointMotion = std::vector<std::pair<std::size_t, PoseTrack>>;

/// The motion of a joint over bones that have grown and stand at rest. At every row of its tables
/// the condyles stand over the plateaus where the description says, and as near to each as at rest:
/// their height and the tilt of the moved bone are found so (Newton's method on the two gaps). A
/// gliding bone goes as near to the fixed one as at rest, its tendon's straight length kept. Fails
/// where no such pose is found.
Result<JointMotion> roll_and_glide(const AnatomyDescription& anatomy, const RollingJoint& joint,
                                   const PlacedBones& at_rest);

/// Works out the motion of every joint over finished bones at rest, keeps it in `grown`, and bends
/// the joints as far as the description says: the bones and bound landmarks of `grown`, and by
/// displacements in the description, all that grows on them later. `file` is for messages;
/// `placed` is not asked for where there are no joints.
Result<void> bend_joints(AnatomyDescription& anatomy, const std::string& file,
                         const PlacedBones& placed, GeneratedAnatomy& grown);

}  // namespace osteon
