#include "osteon/physics/skin_setup.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "physics/skin/grown_knee.h"

namespace osteon {
namespace {

const std::string kSite = "skin:pes_anserinus";

TEST(SkinSetup, WithoutSkinOrSuchAPlaceThereIsNoFrame) {
  const auto nowhere = patch_frame(Case(), kSite, {Vec3::UnitX()});
  ASSERT_FALSE(nowhere);
  EXPECT_NE(nowhere.error().message().find("pes_anserinus"), std::string::npos);
}

TEST(SkinSetup, APatchIsForAPortalByItsPlace) {
  SkinPatch patch;
  for (const auto& [name, is] : {std::pair("skin:portal_al", true),
                                 {"skin:portal_3_4", true},
                                 {"skin:pes_anserinus", false},
                                 {"skin:tibial_tubercle", false}}) {
    patch.name = name;
    EXPECT_EQ(is_for_portal(patch), is) << name;
  }
}

// Left and right knees, bent as a reconstruction has them: the patch over the tendons' insertion
// has room for an incision along the limb, and its fat keeps a careful blade off what lies under.
TEST(SkinSetup, OverTheTendonsThereIsRoomForAnIncision) {
  for (const std::uint64_t seed : {0, 3}) {
    const Case knee = checks::grown_knee(seed, 120);
    const Bone& tibia = knee.bone(knee.find("tibia"));
    Vec3 middle = Vec3::Zero(), far = Vec3::Zero();
    for (const Vec3& p : tibia.mesh.vertices) middle += p;
    middle /= static_cast<double>(tibia.mesh.vertices.size());
    for (const Vec3& p : tibia.mesh.vertices)
      if ((p - middle).norm() > (far - middle).norm()) far = p;
    const Vec3 along_W = tibia.X_WB.rotate((far - middle).normalized());
    const std::vector<std::string> names{"skin:portal_al", "skin:portal_am", kSite};
    const auto patches = make_skin_patches(knee, names, {Vec3::UnitX()}, {});
    ASSERT_TRUE(patches) << seed << patches.error().message();
    const SkinPatch& site = (*patches)[2];
    const Pose X_WS = knee.bone(site.bone).X_WB * site.X_BS;
    const auto frame = patch_frame(knee, kSite, {Vec3::UnitX()});
    ASSERT_TRUE(frame);
    EXPECT_LT((frame->p - X_WS.p).norm(), 1e-9);
    EXPECT_LT(frame->q.angularDistance(X_WS.q), 1e-9);
    EXPECT_GT(std::abs(X_WS.rotate(Vec3::UnitY()).dot(along_W)), 0.97) << seed;
    EXPECT_GE(site.height_m, 0.050) << seed;
    for (const double y : {-0.016, -0.008, 0.0, 0.008, 0.016})
      EXPECT_GT(site.cover.at({0, y}).height_m, 0.0095) << seed << " " << y;
  }
}

}  // namespace
}  // namespace osteon
