#pragma once

#include <optional>

#include "osteon/base/types.h"

namespace osteon {

/// Geometry of the Novint Falcon, a delta robot with three parallelogram legs (Stamper, PhD 97-4,
/// University of Maryland 1997). Frame F: origin in the middle of the base, x right, y up, z out
/// to the user. Angles are those of the three driven joints, rad. Nothing here allocates.
namespace falcon {

/// Angles of the driven joints with the grip at `p_F`; nothing where the legs do not reach.
std::optional<Vec3> joint_angles(const Vec3& p_F);

/// d(angles) / d(p_F), rad/m, row i for leg i; nothing where the legs do not reach or stand
/// stretched. Torques T at the joints hold a force F at the grip when F = J^T T.
std::optional<Mat3> angle_jacobian(const Vec3& p_F);

/// Position of the grip by Newton's method from `guess_F`, to 1e-12 rad; nothing when it does not
/// get there: the angles belong to no position, or to one that the guess is too far from.
std::optional<Vec3> grip_position(const Vec3& angles, const Vec3& guess_F);

/// Joint angles to counts of the encoders and back; zero counts are 35 degrees.
Vec3 angles_of(const std::array<int, 3>& counts);
Vec3 counts_of(const Vec3& angles);

/// Middle of the workspace in F.
inline const Vec3 kCentre_F(0, 0, 0.125);
/// About the step in which a position can be told there, m.
inline constexpr double kResolution_m = 48e-6;

/// Counts for the three motors that give the force `F` at the grip; all are made smaller by one
/// factor when one would pass what the motors take, so that the direction stays. Zero where the
/// legs do not reach.
std::array<int, 3> motor_counts(const Vec3& force_F, const Vec3& p_F);
inline constexpr int kMotorLimit = 4096;
inline constexpr double kCountsPerNm = -10000;

}  // namespace falcon
}  // namespace osteon
