// Small balls in a scope's view: they show where the closed form says.
#include "osteon/render/scope_renderer.h"

#include <cmath>
#include <vector>

#include "gl_fixture.h"
#include "joint_wall.h"

namespace osteon {
namespace {

ScopeDef wide_scope(double angle_deg, double barrel) {
  ScopeDef def;
  def.angle_rad = angle_deg * 3.14159265358979 / 180;
  def.field_rad = 1.83;
  def.barrel = barrel;
  return def;
}

class ScopePictures : public GlTest {
 protected:
  static ScopeRenderer make_scope(const Case& the_case) {
    auto made = ScopeRenderer::create(the_case, OSTEON_SOURCE_DIR, prepare_case(the_case));
    if (!made) throw std::runtime_error(made.error().message());
    return std::move(*made);
  }
};

Case lone_ball(const Vec3& at, double radius_m) {
  Case made;
  made.bones.push_back(make_bone("ball", sphere_mesh(radius_m), at));
  return made;
}

struct Spot {
  double x = 0, y = 0;
  int pixels = 0;
};
/// Middle of all that is bright.
Spot bright_spot(const Image& image) {
  Spot spot;
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x)
      if (brightness(image, x, y) > 60) {
        spot.x += x + 0.5;
        spot.y += y + 0.5;
        ++spot.pixels;
      }
  spot.x /= std::max(spot.pixels, 1);
  spot.y /= std::max(spot.pixels, 1);
  return spot;
}

TEST_F(ScopePictures, ABallShowsWhereItsMiddleIsProjected) {
  for (const double angle_deg : {0.0, 30.0, 70.0})
    for (const double post : {0.0, 1.0, 4.0})
      for (const double barrel : {1.0, 0.6}) {
        ScopePose pose;
        pose.post_rad = post;
        const ScopeCamera camera(wide_scope(angle_deg, barrel), pose);
        const Vec3 at = camera.X_WC() * Vec3(0.006, 0.004, -0.02);
        ScopeRenderer renderer = make_scope(lone_ball(at, 0.0005));
        const Image image = renderer.draw_image(camera, 400, 400);
        ASSERT_FALSE(image.rgb.empty());
        const Spot spot = bright_spot(image);
        const auto want = camera.project({0, 0, 400, 400}, at);
        ASSERT_TRUE(want);
        ASSERT_GT(spot.pixels, 30);
        EXPECT_NEAR(spot.x, want->x, 0.5) << angle_deg << " " << post << " " << barrel;
        EXPECT_NEAR(spot.y, want->y, 0.5) << angle_deg << " " << post << " " << barrel;
      }
}

TEST_F(ScopePictures, ThePictureIsRoundAndFullOfWall) {
  const Case the_case = lone_ball(Vec3(0, 0, -0.012), 0.004);
  ScopeRenderer renderer = make_scope(the_case);
  ASSERT_TRUE(renderer.set_room(Vec3::Zero()));
  const Image image = renderer.draw_image(ScopeCamera(wide_scope(30, 0.6), {}), 300, 200);
  ASSERT_FALSE(image.rgb.empty());
  const double radius = ScopeCamera::radius_px({0, 0, 300, 200});
  for (int y = 0; y < 200; ++y)
    for (int x = 0; x < 300; ++x) {
      const double r = std::hypot(x + 0.5 - 150, y + 0.5 - 100) / radius;
      if (r > 1.03) {
        EXPECT_EQ(brightness(image, x, y), 0) << x << ", " << y;
      } else if (r < 0.9) {
        EXPECT_GT(brightness(image, x, y), 0) << x << ", " << y;
      }
    }
}

TEST_F(ScopePictures, ATipInBoneIsRefusedByName) {
  ScopeRenderer renderer = make_scope(lone_ball(Vec3::Zero(), 0.01));
  const auto room = renderer.set_room(Vec3(0.001, 0, 0));
  ASSERT_FALSE(room);
  EXPECT_NE(room.error().what.find("'ball'"), std::string::npos);
  EXPECT_FALSE(renderer.set_room(Vec3(0, 0, std::nan(""))));
}

TEST(JointWall, EnclosesTheTipAndKeepsOffTheBone) {
  const MeshDistance ball(sphere_mesh(0.01));
  const std::string name = "ball";
  const WalledBone bone{&ball, {}, &name};
  for (const double at_m : {0.012, 0.030}) {
    const Vec3 tip(at_m, 0, 0);
    const auto wall = joint_wall({&bone, 1}, tip);
    ASSERT_TRUE(wall) << wall.error().message();
    const MeshDistance to_wall(*wall);
    EXPECT_LT(to_wall.closest(tip).signed_distance, -0.004);
    for (const Vec3& v : wall->vertices) EXPECT_GT(v.norm(), 0.0185);
  }
}

}  // namespace
}  // namespace osteon
