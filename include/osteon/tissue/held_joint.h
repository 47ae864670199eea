#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include "osteon/base/result.h"
#include "osteon/base/types.h"
#include "osteon/mesh/distance.h"

namespace osteon {

/// Frames of a joint: F is the fixed bone, T the moved one. Of a right knee stretched out both have
/// x along the bone towards the foot, y towards the other leg and z to the front.

/// How the moved bone stands (Grood and Suntay 1983, J Biomech Eng 105:136): bent about y of F,
/// then varus about the floating axis, then turned inwards about the moved bone's own long axis.
struct JointPose {
  double flexion_rad = 0;
  double varus_rad = 0;          ///< the foot towards the other leg
  double internal_rad = 0;       ///< the front towards the other leg
  Vec3 middle_F = Vec3::Zero();  ///< where HeldJoint::middle_T is
};

/// One fibre of a ligament, from the fixed bone to the moved one; a spring that only pulls. Strain
/// e over its slack length; its force is k e^2 / (4 toe) below twice the toe strain and k (e - toe)
/// above (Blankevoort and Huiskes 1991, J Biomech Eng 113:263).
struct JointFibre {
  std::size_t ligament = 0;  ///< to which it belongs
  Vec3 from_F = Vec3::Zero(), to_T = Vec3::Zero();
  double over_m = 0;       ///< of its length, what lies on the moved bone beyond `to_T`
  double slack_m = 0;      ///< where it begins to pull, `over_m` included
  double stiffness_n = 0;  ///< newtons for a strain of 1
  double toe_strain = 0.03;
  double pulled_n = 0;  ///< above 0: not a spring, but pulled by this force whatever its length
};

/// A place on the moved bone under a layer of cartilage: a spring of its own (elastic foundation),
/// pressed by what the layer overlaps the fixed bone's surface.
struct JointBed {
  Vec3 base_T = Vec3::Zero();  ///< on the bone, under the layer
  double thickness_m = 0;      ///< of the layer there
  double stiffness_n_per_m = 0;
};

/// What else is about the joint: weak springs to a pose. They make the place of a slack joint
/// definite.
struct JointSurround {
  double stiffness_n_per_m = 0;
  double across_n_per_m = 0;  ///< along y of F: menisci keep the bones from sliding sideways
  double stiffness_nm_per_rad = 0;
  JointPose about;
};

/// A joint that is held by fibres and carried by cartilage.
struct HeldJoint {
  std::vector<JointFibre> fibres;
  std::vector<JointBed> beds;
  /// Of the fixed bone with its cartilage, in F: what can be touched of it. Null: there is none.
  std::shared_ptr<const MeshDistance> surface_F;
  /// Closed ones: a place inside one of them is inside. None: the surface's own side counts.
  std::vector<std::shared_ptr<const MeshDistance>> solids_F;
  Vec3 middle_T = Vec3::Zero();  ///< loads act here
  JointSurround surround;
};

/// Of fixed direction in F, so that it has a potential. Moments act about the axes of JointPose.
struct JointLoad {
  Vec3 force_F = Vec3::Zero();
  double varus_nm = 0, internal_nm = 0;
};

/// T in F.
Pose pose_of(const HeldJoint& joint, const JointPose& at);
/// The other way; for turns of less than a right angle but for the bend.
JointPose joint_pose(const HeldJoint& joint, const Pose& X_FT);
/// Towards the front of the moved bone at this bend, in F; and along it, towards the foot.
Vec3 front_F(double flexion_rad);
Vec3 along_F(double flexion_rad);

struct FibreState {
  double length_m = 0, strain = 0, tension_n = 0;
};
FibreState fibre_state(const JointFibre& fibre, const Pose& X_FT);

/// A joint in balance.
struct SettledJoint {
  JointPose pose;
  std::vector<FibreState> fibres;
  double contact_n = 0;     ///< sum of the beds' forces
  double unbalanced_n = 0;  ///< what is left of force, and of moment over 30 mm
  double energy_j = 0;      ///< of springs and load
  int rounds = 0;
  bool converged = false;
};

/// Where the moved bone comes to rest at the bend of `start`, which is kept, near `start`. Fails
/// where nothing holds the bone, or a number of the joint is not finite. A pure function, the same
/// bits on every compiler. `converged` is false where neither a balance to 0.1 N was found nor, in
/// a fold of the cartilage, where the force jumps, a pose from which no way of 1 um leads to less
/// energy.
Result<SettledJoint> settle(const HeldJoint& joint, const JointLoad& load, const JointPose& start);

}  // namespace osteon
