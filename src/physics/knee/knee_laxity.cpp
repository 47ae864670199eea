#include <algorithm>
#include <numbers>

#include "osteon/physics/knee_laxity.h"

namespace osteon {
namespace {

constexpr int kQuarters = 4;

struct BothEnds {
  SettledJoint rest, loaded;
};

// After each quarter of the load; its rounds are counted from the rest on.
Result<std::vector<BothEnds>> rest_and_load(const HeldJoint& joint, const JointLoad& seat,
                                            const LaxityTestRow& test, const JointPose& start) {
  const auto rest = settle(joint, seat, start);
  if (!rest) return tl::unexpected(rest.error());
  std::vector<BothEnds> out;
  SettledJoint loaded = *rest;
  for (int k = 1; k <= kQuarters; ++k) {
    const double share = static_cast<double>(k) / kQuarters;
    JointLoad load = seat;
    load.force_F += share * test.anterior_n * front_F(start.flexion_rad);
    load.varus_nm += share * test.varus_nm;
    load.internal_nm += share * test.internal_nm;
    auto next = settle(joint, load, loaded.pose);
    if (!next) return tl::unexpected(next.error());
    next->rounds += loaded.rounds;
    loaded = std::move(*next);
    out.push_back({*rest, loaded});
  }
  return out;
}

std::vector<LigamentPull> pulls(const KneeModel& knee, const BothEnds& ends) {
  std::vector<LigamentPull> out;
  for (const std::string& name : knee.ligaments) out.push_back({name, 0, 0, -1});
  for (std::size_t i = 0; i < knee.joint.fibres.size(); ++i) {
    LigamentPull& pull = out[knee.joint.fibres[i].ligament];
    pull.tension_n += ends.loaded.fibres[i].tension_n;
    pull.unloaded_n += ends.rest.fibres[i].tension_n;
    pull.strain = std::max(pull.strain, ends.loaded.fibres[i].strain);
  }
  return out;
}

KneeLaxity found_at(const KneeModel& knee, const HeldJoint& joint, const BothEnds& ends) {
  const Pose before = pose_of(joint, ends.rest.pose), after = pose_of(joint, ends.loaded.pose);
  const Vec3 front = front_F(ends.rest.pose.flexion_rad);
  const auto forwards = [&](const Vec3& p_T) { return front.dot(after * p_T - before * p_T); };
  KneeLaxity out;
  out.anterior_m = forwards(joint.middle_T);
  out.medial_anterior_m = forwards(knee.medial_T);
  out.lateral_anterior_m = forwards(knee.lateral_T);
  out.internal_rad = ends.loaded.pose.internal_rad - ends.rest.pose.internal_rad;
  out.varus_rad = ends.loaded.pose.varus_rad - ends.rest.pose.varus_rad;
  out.contact_n = ends.loaded.contact_n;
  out.rest = ends.rest.pose;
  out.loaded = ends.loaded.pose;
  out.ligaments = pulls(knee, ends);
  out.rounds = ends.loaded.rounds;
  out.unbalanced_n = std::max(ends.rest.unbalanced_n, ends.loaded.unbalanced_n);
  out.converged = ends.rest.converged && ends.loaded.converged;
  return out;
}

}  // namespace

Result<std::vector<KneeLaxity>> laxity_curve(const KneeModel& knee, const LaxityTestRow& test) {
  HeldJoint joint = knee.joint;
  JointPose start = joint_pose(joint, pose_at(knee.X_FT, test.flexion_deg));
  start.flexion_rad = test.flexion_deg * std::numbers::pi / 180;
  joint.surround.about = start;
  const JointLoad seat{-knee.seating_n * along_F(start.flexion_rad), 0, 0};
  const auto quarters = rest_and_load(joint, seat, test, start);
  if (!quarters) return tl::unexpected(quarters.error());
  std::vector<KneeLaxity> out;
  for (const BothEnds& ends : *quarters) out.push_back(found_at(knee, joint, ends));
  return out;
}

Result<KneeLaxity> test_laxity(const KneeModel& knee, const LaxityTestRow& test) {
  auto curve = laxity_curve(knee, test);
  if (!curve) return tl::unexpected(curve.error());
  return std::move(curve->back());
}

}  // namespace osteon
