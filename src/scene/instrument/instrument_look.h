#pragma once

#include "osteon/mesh/tri_mesh.h"
#include "osteon/scene/instrument.h"

namespace osteon {

/// The closed surface of one part at a size, in Tool, with closed jaws.
TriMesh look_mesh(const LookPart& part, double size_m);

/// Straight bar with flat ends.
TriMesh bar_mesh(const Vec3& from, const Vec3& to, double radius_m);

/// Turn about x, then y, then z.
Quat turn_of(const Vec3& deg);

/// How the parts of a jaw lie at an opening of 0 to 1; the identity for those of none.
Pose jaw_pose(const Instrument& instrument, Jaw jaw, double size_m, double opening);

}  // namespace osteon
