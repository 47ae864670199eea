// What a scope shows by rays, against the share of the picture that a ball takes.
#include "osteon/render/scope_sight.h"

#include <cmath>

#include "../scenes.h"

namespace osteon {
namespace {

Case ball_before_ball() {
  Case made;
  made.bones.push_back(make_bone("near", sphere_mesh(0.002), Vec3(0, 0, -0.01)));
  made.bones.push_back(make_bone("behind", sphere_mesh(0.003), Vec3(0, 0, -0.03)));
  SoftPart pad;
  pad.name = "pad";
  pad.kind = "fat";
  pad.mesh_W = sphere_mesh(0.005);
  made.softs.push_back(pad);
  return made;
}

ScopeCamera looking_straight() {
  ScopeDef def;
  def.field_rad = 1.83;
  return ScopeCamera(def, {});
}

TEST(ScopeSight, ABallTakesTheShareOfTheDiscThatItsAngleGives) {
  const ScopeSight sight = ScopeRays(ball_before_ball()).look(looking_straight(), 200);
  const double radius = looking_straight().radius_share(std::asin(0.2));
  ASSERT_EQ(sight.parts.size(), 1u) << "the ball behind is hidden, fat around the tip is not seen";
  EXPECT_EQ(sight.parts[0].name, "near");
  EXPECT_NEAR(sight.share_of("near"), radius * radius, 0.003);
  EXPECT_NEAR(sight.parts[0].nearest_m, 0.008, 2e-5);
  EXPECT_EQ(sight.share_of("behind"), 0);
}

TEST(ScopeSight, TheTipsRoomIsToTheNearestBoneAndNegativeWithin) {
  Case made = ball_before_ball();
  ScopeSight sight = ScopeRays(made).look(looking_straight(), 8);
  EXPECT_EQ(sight.nearest, "near");
  EXPECT_NEAR(sight.clearance_m, 0.008, 2e-5);
  EXPECT_TRUE(sight.within.empty()) << "fat gives way";
  made.bones[1].X_WB.p = Vec3::Zero();
  made.softs[0].kind = "ligament";
  sight = ScopeRays(made).look(looking_straight(), 8);
  EXPECT_EQ(sight.nearest, "behind");
  EXPECT_NEAR(sight.clearance_m, -0.003, 2e-5);
  EXPECT_EQ(sight.within, "pad");
}

TEST(ScopeSight, NothingIsSeenOfAnEmptyCase) {
  const ScopeSight sight = ScopeRays(Case{}).look(looking_straight());
  EXPECT_TRUE(sight.parts.empty());
  EXPECT_TRUE(std::isinf(sight.clearance_m));
}

}  // namespace
}  // namespace osteon
