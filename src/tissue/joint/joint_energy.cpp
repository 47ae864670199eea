#include "joint/joint_energy.h"

#include <cmath>

#include "joint/fibre_force.h"

namespace osteon {
namespace {

/// Nothing gets deeper into the fixed bone: what is farther from its surface is outside.
constexpr double kDeepest_m = 0.01;
/// Balls about places are smaller by this than what was measured.
constexpr double kSlip_m = 1e-9;

Mat3 turn(const Vec3& axis, double rad) { return Eigen::AngleAxisd(rad, axis).toRotationMatrix(); }

/// The turned bone, with the axes of its two free turns in F.
struct Turned {
  Mat3 R, R_bend;
  Vec3 varus_F, internal_F;
};

Turned turned(const JointPose& pose) {
  Turned out;
  out.R_bend = turn(Vec3::UnitY(), pose.flexion_rad);
  const Mat3 R_varus = out.R_bend * turn(Vec3::UnitZ(), pose.varus_rad);
  out.R = R_varus * turn(Vec3::UnitX(), -pose.internal_rad);
  out.varus_F = out.R_bend.col(2);
  out.internal_F = -R_varus.col(0);
  return out;
}

/// Adds what a force law at one point of the moved bone gives: `slope` is dE/dp, `curvature` its
/// derivative. p = middle + R (b - middle_T), so of the turns a then b about axes of which the
/// first carries the second, dp/da = a x r and d2p/da db = a x (b x r).
void add_point(const Turned& bone, const Vec3& arm_F, const Vec3& slope, const Mat3& curvature,
               JointEnergy& out) {
  Eigen::Matrix<double, 3, 5> J;
  const Vec3 by_varus = bone.varus_F.cross(arm_F) / kJointArm_m;
  const Vec3 by_internal = bone.internal_F.cross(arm_F) / kJointArm_m;
  J << Mat3::Identity(), by_varus, by_internal;
  out.slope += J.transpose() * slope;
  out.curvature += J.transpose() * curvature * J;
  const double vv = slope.dot(bone.varus_F.cross(by_varus)) / kJointArm_m;
  const double vi = slope.dot(bone.varus_F.cross(by_internal)) / kJointArm_m;
  const double ii = slope.dot(bone.internal_F.cross(by_internal)) / kJointArm_m;
  out.curvature(3, 3) += vv;
  out.curvature(3, 4) += vi;
  out.curvature(4, 3) += vi;
  out.curvature(4, 4) += ii;
}

void add_fibre(const JointFibre& fibre, const Turned& bone, const JointPose& pose,
               const Vec3& middle_T, JointEnergy& out) {
  const Vec3 arm_F = bone.R * (fibre.to_T - middle_T);
  const Vec3 way = pose.middle_F + arm_F - fibre.from_F;
  const double free_m = way.norm();
  const FibreForce pull = fibre_force(fibre, free_m + fibre.over_m);
  if (pull.force_n <= 0 || free_m < 1e-9) return;
  const Vec3 n = way / free_m;
  const Mat3 along = n * n.transpose();
  const Mat3 curvature =
      pull.stiffness_n_per_m * along + (pull.force_n / free_m) * (Mat3::Identity() - along);
  out.energy_j += pull.energy_j;
  add_point(bone, arm_F, pull.force_n * n, curvature, out);
}

void add_surround(const JointSurround& surround, const JointPose& pose, JointEnergy& out) {
  JointVector off = coordinates(pose) - coordinates(surround.about);
  JointVector stiffness = JointVector::Constant(surround.stiffness_n_per_m);
  stiffness[1] = surround.across_n_per_m;
  stiffness.tail<2>().setConstant(surround.stiffness_nm_per_rad / (kJointArm_m * kJointArm_m));
  const JointVector force = stiffness.cwiseProduct(off);
  out.energy_j += 0.5 * force.dot(off);
  out.slope += force;
  out.curvature.diagonal() += stiffness;
}

void add_load(const JointLoad& load, const JointPose& pose, JointEnergy& out) {
  out.energy_j -= load.force_F.dot(pose.middle_F) + load.varus_nm * pose.varus_rad +
                  load.internal_nm * pose.internal_rad;
  out.slope.head<3>() -= load.force_F;
  out.slope[3] -= load.varus_nm / kJointArm_m;
  out.slope[4] -= load.internal_nm / kJointArm_m;
}

}  // namespace

JointVector coordinates(const JointPose& pose) {
  JointVector q;
  q << pose.middle_F, kJointArm_m * pose.varus_rad, kJointArm_m * pose.internal_rad;
  return q;
}

JointPose moved(const JointPose& pose, const JointVector& step) {
  JointPose out = pose;
  out.middle_F += step.head<3>();
  out.varus_rad += step[3] / kJointArm_m;
  out.internal_rad += step[4] / kJointArm_m;
  return out;
}

bool JointPotential::is_inside(const Vec3& p_F, const ClosestPoint& at, std::size_t bed) {
  if (joint_.solids_F.empty()) return at.signed_distance < 0;
  const Seen& seen = seen_[bed];
  if ((p_F - seen.at_F).norm() < seen.outside_m) return false;
  if (std::abs(at.signed_distance) > kDeepest_m) return false;
  std::uint32_t* guess = &of_solid_[bed * joint_.solids_F.size()];
  for (const auto& solid : joint_.solids_F) {
    const ClosestPoint found = solid->closest(p_F, *guess);
    *guess++ = found.triangle;
    if (found.signed_distance < 0) return true;
  }
  return false;
}

JointPotential::Gap JointPotential::gap(const Vec3& p_F, std::size_t bed) {
  if (!joint_.surface_F) return {1e300, Vec3::UnitX()};
  Seen& seen = seen_[bed];
  const ClosestPoint at = joint_.surface_F->closest(p_F, seen.triangle);
  seen.triangle = at.triangle;
  const Vec3 away = p_F - at.point;
  const double length = away.norm(), sign = is_inside(p_F, at, bed) ? -1 : 1;
  seen.at_F = p_F;
  seen.outside_m = sign * length - kSlip_m;
  return {sign * length, length > 1e-12 ? Vec3(away * (sign / length)) : Vec3(Vec3::UnitX())};
}

JointEnergy JointPotential::at(const JointPose& pose) {
  JointEnergy out;
  const Turned bone = turned(pose);
  for (const JointFibre& fibre : joint_.fibres) add_fibre(fibre, bone, pose, joint_.middle_T, out);
  for (std::size_t i = 0; i < joint_.beds.size(); ++i) {
    const JointBed& bed = joint_.beds[i];
    Seen& seen = seen_[i];
    const Vec3 arm_F = bone.R * (bed.base_T - joint_.middle_T);
    const Vec3 p_F = pose.middle_F + arm_F;
    if ((p_F - seen.at_F).norm() < seen.free_m) continue;
    const Gap g = gap(p_F, i);
    const double overlap = bed.thickness_m - g.distance_m;
    seen.free_m = -overlap - kSlip_m;
    if (overlap <= 0) continue;
    const double force = bed.stiffness_n_per_m * overlap;
    out.contact_n += force;
    out.energy_j += 0.5 * force * overlap;
    const Mat3 curvature = bed.stiffness_n_per_m * g.away_F * g.away_F.transpose();
    add_point(bone, arm_F, -force * g.away_F, curvature, out);
  }
  add_surround(joint_.surround, pose, out);
  add_load(load_, pose, out);
  return out;
}

Pose pose_of(const HeldJoint& joint, const JointPose& at) {
  const Mat3 R = turned(at).R;
  return {at.middle_F - R * joint.middle_T, Quat(R)};
}

JointPose joint_pose(const HeldJoint& joint, const Pose& X_FT) {
  // R = Ry(bend) Rz(varus) Rx(-internal).
  const Mat3 R = X_FT.q.toRotationMatrix();
  JointPose out;
  out.varus_rad = std::asin(std::min(1.0, std::max(-1.0, R(1, 0))));
  out.flexion_rad = std::atan2(-R(2, 0), R(0, 0));
  out.internal_rad = std::atan2(R(1, 2), R(1, 1));
  out.middle_F = X_FT * joint.middle_T;
  return out;
}

Vec3 front_F(double flexion_rad) { return turn(Vec3::UnitY(), flexion_rad).col(2); }
Vec3 along_F(double flexion_rad) { return turn(Vec3::UnitY(), flexion_rad).col(0); }

}  // namespace osteon
