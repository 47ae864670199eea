#pragma once

#include "osteon/base/types.h"
#include "osteon/mesh/tri_mesh.h"

namespace osteon {

/// A string from one point to another, drawn over a bone.
struct TautOver {
  Vec3 first = Vec3::Zero();  ///< where it first touches the bone; its end where it does not
  double rest_m = 0;          ///< its length from there to its end
};

/// The string lies in the plane of both ends and `outward`, on that side of the bone. Of the bone's
/// section by this plane it follows the convex outline, which is shortest in the plane.
TautOver taut_over(const TriMesh& bone, const Vec3& from, const Vec3& to, const Vec3& outward);

}  // namespace osteon
