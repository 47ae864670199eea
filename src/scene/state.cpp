#include "osteon/scene/state.h"

#include "osteon/base/check.h"

namespace osteon {

BoneSnapshot rest_snapshot(const Case& the_case) {
  demand(the_case.bones.size() <= kMaxBones, "a case has more bones than a snapshot holds");
  BoneSnapshot snapshot;
  snapshot.count = static_cast<std::uint32_t>(the_case.bones.size());
  for (std::size_t i = 0; i < the_case.bones.size(); ++i)
    snapshot.bones[i].X_WB = the_case.bones[i].X_WB;
  return snapshot;
}

OtherTool seen_from_outside(const ToolState& tool) {
  return {tool.tick, tool.instrument, tool.X_WD.p, tool.X_WP, tool.v_W};
}

BoneSnapshot bent_snapshot(const Case& the_case, const CaseJoint& joint, double degrees) {
  BoneSnapshot snapshot = rest_snapshot(the_case);
  const Pose X_WF = the_case.bone(joint.fixed).X_WB;
  for (const CaseJoint::Moved& moved : joint.bones)
    snapshot.bones[moved.bone.index].X_WB = X_WF * pose_at(moved.X_FB, degrees);
  return snapshot;
}

}  // namespace osteon
