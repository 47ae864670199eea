#include "osteon/scene/marks_now.h"

#include <algorithm>
#include <cmath>

#include "osteon/mesh/distance.h"

namespace osteon {
namespace {

// Of a bone that a joint moves.
BoneId moving_bone(const Case& the_case, std::uint32_t landmark) {
  if (landmark >= the_case.landmarks.size() || the_case.landmarks[landmark].bone.empty()) return {};
  const BoneId bone = the_case.find(the_case.landmarks[landmark].bone);
  if (!bone.valid()) return {};
  for (const CaseJoint& joint : the_case.joints)
    if (std::any_of(joint.bones.begin(), joint.bones.end(),
                    [&](const CaseJoint::Moved& moved) { return moved.bone == bone; }))
      return bone;
  return {};
}

bool is_same(const Pose& a, const Pose& b) { return a.p == b.p && a.q.coeffs() == b.q.coeffs(); }

}  // namespace

Pose moved_from_rest(const Case& the_case, std::uint32_t landmark, const BoneSnapshot& bones) {
  const BoneId bone = moving_bone(the_case, landmark);
  if (!bone.valid() || bone.index >= bones.count) return {};
  const Pose& rest = the_case.bone(bone).X_WB;
  const Pose& now = bones.bones[bone.index].X_WB;
  return is_same(rest, now) ? Pose{} : now * rest.inverse();
}

Vec3 place_now(const Case& the_case, std::uint32_t landmark, const BoneSnapshot& bones) {
  return moved_from_rest(the_case, landmark, bones) * the_case.landmarks[landmark].p_W;
}

std::optional<std::uint32_t> meniscus_under(const Case& the_case, std::uint32_t landmark) {
  constexpr double kOn_m = 0.001;
  if (landmark >= the_case.landmarks.size()) return {};
  const Vec3& p_W = the_case.landmarks[landmark].p_W;
  for (std::uint32_t i = 0; i < the_case.softs.size(); ++i) {
    const SoftPart& soft = the_case.softs[i];
    if (soft.kind != "meniscus" || soft.mesh_W.triangles.empty()) continue;
    if (std::abs(MeshDistance(soft.mesh_W).closest(p_W).signed_distance) < kOn_m) return i;
  }
  return {};
}

BoneSnapshot begun_bones(const Case& the_case) {
  BoneSnapshot begun;
  begun.count = static_cast<std::uint32_t>(the_case.bones.size());
  for (std::size_t b = 0; b < the_case.bones.size(); ++b)
    begun.bones[b].X_WB = the_case.bones[b].X_WB;
  for (const CaseJoint& joint : the_case.joints) {
    if (!joint.begin_deg) continue;
    const Pose& X_WF = the_case.bone(joint.fixed).X_WB;
    for (const CaseJoint::Moved& moved : joint.bones)
      begun.bones[moved.bone.index].X_WB = X_WF * pose_at(moved.X_FB, *joint.begin_deg);
  }
  return begun;
}

Case as_it_begins(const Case& the_case) {
  const BoneSnapshot begun = begun_bones(the_case);
  Case out;
  out.name = the_case.name;
  out.side = the_case.side;
  out.bones = the_case.bones;
  out.landmarks = the_case.landmarks;
  for (std::uint32_t i = 0; i < out.landmarks.size(); ++i) {
    const Pose moved = moved_from_rest(the_case, i, begun);
    out.landmarks[i].p_W = moved * the_case.landmarks[i].p_W;
    out.landmarks[i].inwards_W = moved.rotate(the_case.landmarks[i].inwards_W);
  }
  for (std::size_t b = 0; b < out.bones.size(); ++b) out.bones[b].X_WB = begun.bones[b].X_WB;
  return out;
}

}  // namespace osteon
