#pragma once

#include <optional>

#include "describe/description.h"

namespace osteon {

/// Pose of a bone as it grows, before any finding moves it.
Pose rest_pose(const BoneDescription& bone);

/// How findings and bent joints move a bone away from rest, in World; none: it stays.
std::optional<Pose> displacement_of(const AnatomyDescription& anatomy, std::size_t bone);
/// The same, of bent joints alone.
std::optional<Pose> bend_of(const AnatomyDescription& anatomy, std::size_t bone);

/// Where a landmark comes that stays beside a band: it goes with its bone, and over that as the
/// straight way between the band's ends shifts beside it, by all that moves bones. `landmark` names
/// a band and a bone.
Vec3 moved_beside_band(const AnatomyDescription& anatomy, const LandmarkDescription& landmark);

/// Moves a primitive of World by X.
void move_rigidly(const Pose& X, Primitive& primitive);

/// Moves what is bound to displaced bones along with them: points and parts of soft parts, and
/// landmarks that are bound. Bones themselves and cartilage stay in the description.
void move_bound_along(AnatomyDescription& anatomy);

}  // namespace osteon
