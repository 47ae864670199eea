#include "osteon/surgeon/acl_plan.h"

#include "acl_lines.h"

namespace osteon {
namespace {

Pose to_bone(const Case& the_case, const char* name) {
  return the_case.bones[the_case.find(name).index].X_WB.inverse();
}

}  // namespace

Result<AclPlan> plan_tunnels(const Case& the_case, std::string_view fault, double reamed_m,
                             bool spares_softs) {
  auto knee = AclKnee::make(the_case);
  if (!knee) return tl::unexpected(knee.error());
  if (spares_softs) knee->spare_softs();
  const auto tibia = tibial_line(*knee, fault, Vec3::Zero(), reamed_m);
  if (!tibia) return tl::unexpected(tibia.error());
  const auto femur = femoral_line(*knee, fault, Vec3::Zero(), reamed_m);
  if (!femur) return tl::unexpected(femur.error());
  const Pose X_FW = to_bone(the_case, "femur"), X_TW = to_bone(the_case, "tibia");
  return AclPlan{X_FW * femur->at_W, X_FW.rotate(femur->in_W), X_TW * tibia->at_W,
                 X_TW.rotate(tibia->in_W)};
}

}  // namespace osteon
