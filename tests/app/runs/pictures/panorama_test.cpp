#include "runs/pictures/panorama.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "xray/phantoms.h"

namespace osteon {
namespace {

Bone ball_at(const std::string& name, const Vec3& p_W) {
  Bone bone;
  bone.name = name;
  bone.mesh = testing_xray::ball(Vec3::Zero(), 0.03, 12);
  bone.X_WB = {p_W, Quat::Identity()};
  return bone;
}

// Femur, tibia and patella near the origin; the fibula's end is so far away.
Case a_knee(double fibula_m) {
  Case out;
  out.name = "knee";
  out.bones = {ball_at("femur", Vec3(-0.03, 0, 0)), ball_at("tibia", Vec3(0.03, 0, 0)),
               ball_at("patella", Vec3(0, 0, 0.03)), ball_at("fibula", Vec3(fibula_m, 0, 0))};
  return out;
}

TEST(Panorama, AnotherSideIsRefused) { EXPECT_FALSE(panorama_camera(a_knee(0.05), "under", 1)); }

TEST(Panorama, OfAKneeThatIsCutOffAFarFibulaDoesNotMakeTheJointSmall) {
  for (const char* side : {"front", "top", "left"}) {
    const auto near = panorama_camera(a_knee(0.05), side, 1.6);
    const auto far = panorama_camera(a_knee(0.6), side, 1.6);
    ASSERT_TRUE(near && far);
    EXPECT_LT((far->target_W - Vec3(0, 0, 0.015)).norm(), 1e-3) << side;
    EXPECT_LT(far->distance_m, 1.5 * near->distance_m) << side;
    // All of the three bones is in the picture.
    const Pose X_CW = far->X_WC().inverse();
    for (const Vec3& p_W : {Vec3(-0.06, 0, 0), Vec3(0.06, 0, 0), Vec3(0, 0, 0.06)}) {
      const Vec3 p_C = X_CW * p_W;
      EXPECT_LT(std::abs(p_C.y() / -p_C.z()), std::tan(0.5 * far->vertical_fov_rad)) << side;
    }
  }
}

TEST(Panorama, ALimbThatIsWholeIsSeenWhole) {
  Case wrist = a_knee(0.6);
  wrist.bones[0].name = "radius";
  const auto camera = panorama_camera(wrist, "left", 1);
  ASSERT_TRUE(camera);
  EXPECT_LT((camera->target_W - wrist.bounds_W().center()).norm(), 1e-12);
  for (const BoneAppearance& bone : panorama_view(wrist, *camera).bones) {
    EXPECT_TRUE(bone.visible);
    EXPECT_LT(bone.opacity, 1);
  }
}

}  // namespace
}  // namespace osteon
