#pragma once

#include <span>

#include "osteon/base/types.h"
#include "osteon/hull/hull.h"
#include "osteon/physics/bone_loss.h"

namespace osteon {

/// Of a rigid body, in its own frame B. I is the frame at the centre of mass along the principal
/// axes.
struct MassProperties {
  double mass_kg = 0;
  Pose X_BI;
  Vec3 moments = Vec3::Ones();  ///< about I's axes, kg m^2
};

/// Of closed hulls of one density that together weigh `mass_kg`; what two pieces share counts
/// twice. Hulls without volume (or no hulls) give a ball of 5 mm radius around their middle.
MassProperties mass_properties(std::span<const Hull> pieces, double mass_kg);

/// What is left of a body. At least a twentieth of its mass, and a hundredth of its least moment,
/// stay: a body of nothing cannot be moved.
MassProperties less(const MassProperties& whole, const BoneLoss& loss);

/// Eigenvectors (columns, right-handed) of a symmetric matrix by Jacobi's rotations, with only
/// square roots: the same bits on every machine. `values`: the eigenvalues.
Mat3 principal_axes(const Mat3& symmetric, Vec3& values);

}  // namespace osteon
