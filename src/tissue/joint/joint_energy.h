#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "osteon/tissue/held_joint.h"

namespace osteon {

/// The joint's free coordinates, all in metres: place of the middle, then varus and internal turn
/// times an arm.
using JointVector = Eigen::Matrix<double, 5, 1>;
using JointMatrix = Eigen::Matrix<double, 5, 5>;
inline constexpr double kJointArm_m = 0.03;

/// Energy with its slope, N, and its curvature, N/m (that of surfaces left out).
struct JointEnergy {
  double energy_j = 0;
  JointVector slope = JointVector::Zero();
  JointMatrix curvature = JointMatrix::Zero();
  double contact_n = 0;
};

/// Works out energies of one joint under one load. It remembers how far each bed was from the fixed
/// bone, which saves searches and changes no bit.
class JointPotential {
 public:
  JointPotential(const HeldJoint& joint, const JointLoad& load)
      : joint_(joint),
        load_(load),
        seen_(joint.beds.size()),
        of_solid_(joint.beds.size() * joint.solids_F.size(), 0) {}

  JointEnergy at(const JointPose& pose);

 private:
  /// Where a bed was when it was looked at. Within a ball about that it stays free of the bone, and
  /// within another, whose rim just touches the bone, outside.
  struct Seen {
    Vec3 at_F = Vec3::Zero();
    double free_m = -1, outside_m = -1;
    std::uint32_t triangle = 0;
  };
  /// How far the fixed bone's surface is, negative inside, and the way out of it.
  struct Gap {
    double distance_m = 0;
    Vec3 away_F = Vec3::UnitX();
  };
  Gap gap(const Vec3& p_F, std::size_t bed);
  bool is_inside(const Vec3& p_F, const ClosestPoint& at, std::size_t bed);

  const HeldJoint& joint_;
  const JointLoad& load_;
  std::vector<Seen> seen_;
  std::vector<std::uint32_t> of_solid_;  ///< the triangle last found, by bed, then by solid
};

JointVector coordinates(const JointPose& pose);
JointPose moved(const JointPose& pose, const JointVector& step);

}  // namespace osteon
