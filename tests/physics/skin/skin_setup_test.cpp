#include "osteon/physics/skin_setup.h"

#include <gtest/gtest.h>

#include <array>
#include <cstdio>
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
TEST(SkinSetup, OverTheTendonsOfManyPatientsThereIsRoomForAnIncision) {
  for (const std::uint64_t seed : {0, 1, 2, 3, 4, 5}) {
    const Case knee = checks::grown_knee(seed, 120);
    Vec3 along_W = Vec3::Zero();
    for (const Landmark& mark : knee.landmarks) {
      if (mark.name == "acl_tibia") along_W -= mark.p_W;
      if (mark.name == "tibial_tubercle") along_W += mark.p_W;
    }
    const std::vector<std::string> names{"skin:portal_al", "skin:portal_am", kSite};
    const auto patches = make_skin_patches(knee, names, {Vec3::UnitX()}, {});
    ASSERT_TRUE(patches) << seed << patches.error().message();
    const SkinPatch& site = (*patches)[2];
    const Pose X_WS = knee.bone(site.bone).X_WB * site.X_BS;
    const auto frame = patch_frame(knee, kSite, {Vec3::UnitX()});
    ASSERT_TRUE(frame);
    EXPECT_LT((frame->p - X_WS.p).norm(), 1e-9);
    EXPECT_LT(frame->q.angularDistance(X_WS.q), 1e-9);
    std::array<double, 5> deep{};
    for (int i = 0; i < 5; ++i) deep[i] = 1e3 * site.cover.at({0, 0.008 * (i - 2)}).height_m;
    std::printf(
        "patient %d: %.0f x %.0f mm, %.1f %.1f %.1f %.1f %.1f deep, y along the limb %.2f\n",
        int(seed), 1e3 * site.width_m, 1e3 * site.height_m, deep[0], deep[1], deep[2], deep[3],
        deep[4], X_WS.rotate(Vec3::UnitY()).dot(along_W.normalized()));
    EXPECT_GE(site.height_m, 0.040) << seed;
  }
}

}  // namespace
}  // namespace osteon
