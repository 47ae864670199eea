// Lines that the virtual surgeon plans in generated knees.
#include "osteon/surgeon/acl_plan.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <utility>

#include "cases/open_case.h"
#include "osteon/mesh/distance.h"
#include "osteon/procedure/judge.h"

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

// The least room about the way to a socket, as the drill's head passes it, to menisci and the other
// cruciate ligament.
double least_soft_room(const Case& knee, const AclPlan& plan) {
  const Bone& femur = knee.bones[knee.find("femur").index];
  double least = 1;
  for (const SoftPart& part : knee.softs) {
    if (part.kind != "meniscus" && part.name != "pcl") continue;
    const MeshDistance to_part(part.mesh_W);
    for (double before = 0.005; before < 0.06; before += 0.0005)
      least = std::min(
          least,
          to_part.closest(femur.X_WB * (plan.femur_B - before * plan.femur_in_B)).signed_distance);
  }
  return least;
}

// Whose menisci and ligaments are felt is not drilled through them: another line is taken where the
// first would meet one, and the same where it does not.
TEST(AclPlan, TheWayToTheFemurKeepsOffWhatIsSoftAndSpared) {
  constexpr double kRadius_m = 0.004;
  int met = 0, kept = 0;
  for (const char* spec : {
           "builtin:knee:3:right:acl_tear=midsubstance#hull,flexion=120",
           "builtin:knee:0:right:acl_tear=midsubstance#hull,flexion=120",
       }) {
    SCOPED_TRACE(spec);
    const auto knee = open_case(spec);
    ASSERT_TRUE(knee) << knee.error().message();
    const auto heedless = plan_tunnels(**knee, "", 2 * kRadius_m);
    const auto sparing = plan_tunnels(**knee, "", 2 * kRadius_m, true);
    ASSERT_TRUE(heedless && sparing);
    if (least_soft_room(**knee, *heedless) < kRadius_m) {
      ++met;
      EXPECT_GT(least_soft_room(**knee, *sparing), kRadius_m);
    } else {
      ++kept;
      EXPECT_EQ(sparing->femur_in_B, heedless->femur_in_B);
      EXPECT_EQ(sparing->femur_B, heedless->femur_B);
    }
  }
  EXPECT_GT(met, 0);
  EXPECT_GT(kept, 0);
}

// Least distance of a new axis, as far as `length_m`, from that of an old tunnel.
double from_old(const Case& knee, bool of_femur, const AclPlan& plan, double length_m) {
  const Bone& bone = knee.bones[knee.find(of_femur ? "femur" : "tibia").index];
  const auto mark = [&](const char* name) {
    return bone.X_WB.inverse() * knee.landmarks[*find_landmark(knee, name)].p_W;
  };
  const Vec3 from = mark(of_femur ? "old_socket_mouth" : "old_tunnel_mouth");
  const Vec3 to = mark(of_femur ? "old_socket_end" : "old_tunnel_end");
  const Vec3 at = of_femur ? plan.femur_B : plan.tibia_B;
  const Vec3 in = of_femur ? plan.femur_in_B : plan.tibia_in_B;
  double least = 1;
  for (double m = 0; m < length_m; m += 0.0005) {
    const Vec3 off = at + m * in - from, way = to - from;
    const double share = std::clamp(off.dot(way) / way.squaredNorm(), 0.0, 1.0);
    least = std::min(least, (off - share * way).norm());
  }
  return least;
}

TEST(AclPlan, BesideAnOldTunnelBoneIsLeftAndWhoErrsOpensIt) {
  constexpr double kBoth_m = 0.004 + 0.0037;  // radii of a new one and an old one
  const auto knee =
      open_case("builtin:knee:3:right:old_socket=front:old_tunnel=back#hull,flexion=120");
  ASSERT_TRUE(knee) << knee.error().message();
  const auto expert = plan_tunnels(**knee, "", 0.008);
  ASSERT_TRUE(expert) << expert.error().message();
  EXPECT_GT(from_old(**knee, true, *expert, 0.025), kBoth_m + 0.0015);
  EXPECT_GT(from_old(**knee, false, *expert, 0.035), kBoth_m + 0.0015);
  const auto opened = plan_tunnels(**knee, "into_old_tunnel", 0.008);
  ASSERT_TRUE(opened) << opened.error().message();
  EXPECT_LT(from_old(**knee, false, *opened, 0.035), kBoth_m - 0.0008);
}

}  // namespace
}  // namespace osteon
