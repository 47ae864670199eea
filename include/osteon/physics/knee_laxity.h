#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "osteon/base/pose_track.h"
#include "osteon/base/result.h"
#include "osteon/scene/build_case.h"
#include "osteon/tissue/held_joint.h"
#include "osteon/tissue/ligament_table.h"

namespace osteon {

/// A graft in a ligament's place; what is not said is as in the table.
struct KneeGraft {
  std::optional<Vec3> from_W, to_W;  ///< on femur and tibia, bones at rest; none: the footprints
  std::optional<double> diameter_m, tension_n, flexion_deg;
  std::optional<double> fixation_n_per_m = {};  ///< button, loop and screw together
  double slack_m = 0;  ///< that creep and slip add to its length once it is fixed
  bool held = true;    ///< false: nothing fixes it; it stands in the table but does not pull
};

/// What is done to a knee before it is tested.
struct KneeChanges {
  bool heal = false;                 ///< findings do not count: as the other knee
  std::vector<std::string> without;  ///< ligaments that are cut
  std::optional<KneeGraft> graft;
};

/// A knee as a joint that its ligaments hold, always as a right one: a left knee is mirrored.
/// Frames as in held_joint.h; both coincide when the knee is stretched out.
struct KneeModel {
  HeldJoint joint;
  std::vector<std::string> ligaments;  ///< their names; JointFibre::ligament counts these
  std::vector<std::string> absent;     ///< of the table, what the case does not have
  PoseTrack X_FT;                      ///< bending without load, by degrees
  Vec3 medial_T = Vec3::Zero(), lateral_T = Vec3::Zero();  ///< middles of the plateaus
  double seating_n = 0;
};

/// The knee of a case, its fibres at the case's own footprints, changed as said. Fails, with what
/// is missing, where there is no femur, tibia, cartilage or bending joint; where a ligament is
/// named that the table lacks; and where nothing is left that holds the tibia.
Result<KneeModel> make_knee(const CaseDef& def, const LigamentTable& table,
                            const KneeChanges& changes = {});

/// How a ligament pulls: the sum over its fibres, and the greatest strain of one.
struct LigamentPull {
  std::string name;
  double tension_n = 0, unloaded_n = 0;
  double strain = 0;
};

/// What a test found: ways and turns of the tibia from where it rests without load.
struct KneeLaxity {
  double anterior_m = 0;  ///< of the middle between the plateaus
  double medial_anterior_m = 0, lateral_anterior_m = 0;
  double internal_rad = 0, varus_rad = 0;
  double contact_n = 0;
  JointPose rest, loaded;
  std::vector<LigamentPull> ligaments;
  int rounds = 0;
  double unbalanced_n = 0;
  bool converged = false;
};

/// The knee is bent as the test says and the bend held; the tibia comes to rest, is loaded by
/// quarters, and comes to rest again.
Result<KneeLaxity> test_laxity(const KneeModel& knee, const LaxityTestRow& test);

/// What it finds after each quarter of the load; the last is the test's own.
Result<std::vector<KneeLaxity>> laxity_curve(const KneeModel& knee, const LaxityTestRow& test);

/// Length of the straight line from a place on the femur to one on the tibia at a bend.
struct LineLength {
  double flexion_deg = 0, length_m = 0;
};
/// Both places in World, bones at rest; every 10 degrees of the case's own bending, to 130 or its
/// end.
Result<std::vector<LineLength>> line_over_flexion(const CaseDef& def, const Vec3& from_W,
                                                  const Vec3& to_W);

}  // namespace osteon
