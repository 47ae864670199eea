#pragma once

#include <span>
#include <string>

#include "osteon/base/result.h"
#include "osteon/mesh/distance.h"
#include "osteon/scene/case.h"

namespace osteon {

/// A bone and where it stands.
struct WalledBone {
  const MeshDistance* surface;
  Pose X_WB;
  const std::string* name;
};

/// The room around a tip, as a closed surface in World that faces outwards: a smooth offset of the
/// bones near by, cut off 60 mm from the tip. Fails when the tip lies in a bone.
Result<TriMesh> joint_wall(std::span<const WalledBone> bones, const Vec3& tip_W);

}  // namespace osteon
