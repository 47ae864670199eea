#include "watch/tip_sight.h"

#include <gtest/gtest.h>

#include <array>
#include <utility>

#include "../../mesh/shapes.h"
#include "osteon/scene/build_case.h"

namespace osteon {
namespace {

// A ball of 5 mm at the origin; the first hand has the scope, which looks down along z.
struct TipSightRig {
  TipSightRig() {
    BoneDef ball;
    ball.name = "ball";
    ball.felt = Felt::kHull;
    ball.mesh = test::sphere(0.005, 12);
    CaseDef def;
    def.name = "ball";
    def.bones = {ball};
    auto built = build_case(std::move(def));
    EXPECT_TRUE(built) << built.error().message();
    the_case.emplace(std::move(*built));
    scope.portal = 0;
    scope.X_WP = {Vec3(0, 0, 0.03), Quat::Identity()};
  }
  bool sees(const Vec3& tip_W) {
    ToolState worker;
    worker.X_WP = {tip_W, Quat::Identity()};
    const std::array<const ToolState*, 2> tools{&scope, &worker};
    return is_tip_seen(*the_case, optics, tools, 1, rest_snapshot(*the_case));
  }
  std::optional<Case> the_case;
  std::array<std::optional<ScopeOptics>, 2> optics{ScopeOptics{0, 0.5}, std::nullopt};
  ToolState scope;
};

TEST(TipSight, InThePictureNearEnoughAndNotBehindBone) {
  TipSightRig rig;
  EXPECT_TRUE(rig.sees({0, 0, 0.01}));
  EXPECT_TRUE(rig.sees({0.01, 0, 0}));
  EXPECT_FALSE(rig.sees({0, 0, -0.02}));     // behind the ball
  EXPECT_FALSE(rig.sees({0.03, 0, 0}));      // beside the picture
  EXPECT_FALSE(rig.sees({0.03, 0, -0.06}));  // too far
  EXPECT_FALSE(rig.sees(rig.scope.X_WP.p));  // right at the window
}

TEST(TipSight, OnlyThroughAScopeInAPortalOfAnotherHand) {
  TipSightRig rig;
  rig.scope.portal = kNoPortal;
  EXPECT_FALSE(rig.sees({0, 0, 0.01}));
  rig.scope.portal = 0;
  rig.optics = {std::nullopt, ScopeOptics{0, 3}};
  EXPECT_FALSE(rig.sees({0, 0, 0.01}));
}

}  // namespace
}  // namespace osteon
