// Lines that the virtual surgeon plans in generated knees.
#include "osteon/surgeon/acl_plan.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <utility>

#include "cases/open_case.h"
#include "osteon/mesh/distance.h"

namespace osteon {
namespace {

// The least room about the way to a socket, over the stretch that the drill's body passes.
double least_room(const Case& knee, const AclPlan& plan) {
  const Bone& femur = knee.bones[knee.find("femur").index];
  const Bone& tibia = knee.bones[knee.find("tibia").index];
  const MeshDistance to_femur(femur.mesh), to_tibia(tibia.mesh);
  double least = 1;
  for (double before = 0.013; before < 0.09; before += 0.0005) {
    const Vec3 p_F = plan.femur_B - before * plan.femur_in_B;
    const Vec3 p_T = tibia.X_WB.inverse() * (femur.X_WB * p_F);
    least = std::min(
        {least, to_femur.closest(p_F).signed_distance, to_tibia.closest(p_T).signed_distance});
  }
  return least;
}

// The grafts of these patients pass 8.5 and 9 mm; where their lines left room for a drill of 8 mm
// alone, the wider one met the tibia.
TEST(AclPlan, AWiderDrillHasItsRoomOnTheWay) {
  for (const auto& [spec, reamed_m] :
       {std::pair("builtin:knee:10:right:acl_tear=midsubstance#hull,flexion=120", 0.0085),
        std::pair("builtin:knee:13:left:acl_tear=midsubstance#hull,flexion=120", 0.009)}) {
    const auto knee = open_case(spec);
    ASSERT_TRUE(knee) << knee.error().message();
    const auto plan = plan_tunnels(**knee, "", reamed_m);
    ASSERT_TRUE(plan) << plan.error().message();
    EXPECT_GT(least_room(**knee, *plan), 0.5 * reamed_m) << spec;
  }
}

}  // namespace
}  // namespace osteon
