#include "case/build_joints.h"

#include <cmath>
#include <set>
#include <string>
#include <utility>

namespace osteon {
namespace {

bool is_sound(const PoseTrack& track) {
  if (track.poses.empty() || !std::isfinite(track.first) || !std::isfinite(track.step))
    return false;
  if (track.step <= 0) return false;
  for (const Pose& X : track.poses)
    if (!is_finite(X) || std::abs(X.q.norm() - 1) > 1e-6) return false;
  return true;
}

Result<BoneId> joined_bone(const std::vector<Bone>& bones, const std::string& name,
                           const std::string& where) {
  for (std::uint32_t i = 0; i < bones.size(); ++i)
    if (bones[i].name == name) return BoneId{i};
  return fail("there is no bone '" + name + "'", where, "Name a bone of the case");
}

Result<CaseJoint> build_joint(JointDef def, const std::vector<Bone>& bones) {
  const std::string where = "joint '" + def.name + "'";
  if (def.name.empty()) return fail("a joint has no name", "case", "Give every one a name");
  if (def.bones.empty()) return fail("it moves no bone", where);
  const auto fixed = joined_bone(bones, def.fixed, where);
  if (!fixed) return tl::unexpected(fixed.error());
  CaseJoint joint{def.name, *fixed, def.at_deg, {}};
  std::set<std::uint32_t> taken{fixed->index};
  for (JointDef::Moved& moved : def.bones) {
    const auto bone = joined_bone(bones, moved.bone, where);
    if (!bone) return tl::unexpected(bone.error());
    if (!taken.insert(bone->index).second)
      return fail("it names '" + moved.bone + "' twice", where);
    if (!is_sound(moved.X_FB))
      return fail("the poses of '" + moved.bone + "' are not finite with unit quaternions", where);
    joint.bones.push_back({*bone, std::move(moved.X_FB)});
    const PoseTrack& track = joint.bones.back().X_FB;
    if (track.first != joint.min_deg() || track.last() != joint.max_deg())
      return fail("its bones have different ranges", where);
  }
  if (!(def.at_deg >= joint.min_deg() && def.at_deg <= joint.max_deg()))
    return fail("it is bent beyond its range", where);
  joint.begin_deg = def.begin_deg;
  if (joint.begin_deg &&
      !(*joint.begin_deg >= joint.min_deg() && *joint.begin_deg <= joint.max_deg()))
    return fail("it would begin beyond its range", where);
  return joint;
}

}  // namespace

Result<std::vector<CaseJoint>> build_joints(std::vector<JointDef> defs,
                                            const std::vector<Bone>& bones) {
  std::vector<CaseJoint> joints;
  std::set<std::string> names;
  for (JointDef& def : defs) {
    if (!names.insert(def.name).second)
      return fail("two joints have the name '" + def.name + "'", "case", "Rename one of them");
    auto joint = build_joint(std::move(def), bones);
    if (!joint) return tl::unexpected(joint.error());
    joints.push_back(std::move(*joint));
  }
  return joints;
}

}  // namespace osteon
