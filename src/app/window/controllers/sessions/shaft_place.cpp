#include "window/controllers/sessions/shaft_place.h"

#include "osteon/base/turn.h"

namespace osteon {

Vec3 shaft_beside_tip(const Tool& tool) { return {tool.shaft.p0.x(), tool.shaft.p0.y(), 0}; }

Pose before_portal(const Tool& tool, const Vec3& p_W, const Vec3& inwards_W, double before_m) {
  const Quat q = turn_between(Vec3::UnitZ(), -inwards_W).normalized();
  return {p_W - before_m * inwards_W - q * shaft_beside_tip(tool), q};
}

Pose on_the_same_line(const Tool& before, const Tool& now, const Pose& X_WT) {
  return {X_WT * Vec3(shaft_beside_tip(before) - shaft_beside_tip(now)), X_WT.q};
}

}  // namespace osteon
