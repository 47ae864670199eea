// Small balls in a scope's view: they show where the closed form says.
#include "osteon/render/scope_renderer.h"

#include <cmath>
#include <string>
#include <vector>

#include "gl/render_target.h"
#include "gl_fixture.h"
#include "osteon/render/joint_room.h"
#include "surface/joint_wall.h"

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
  const auto wall = JointRoom(the_case).wall(rest_snapshot(the_case), Vec3::Zero());
  ASSERT_TRUE(wall);
  renderer.set_wall(*wall);
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

double mean_channel(const Image& image, int channel) {
  double sum = 0;
  for (std::size_t k = static_cast<std::size_t>(channel); k < image.rgb.size(); k += 3)
    sum += image.rgb[k];
  return sum / static_cast<double>(image.rgb.size() / 3);
}

/// Five times five small balls across the view: rims that no material's pattern hides.
Case rows_of_balls() {
  Case made;
  for (int row = -2; row <= 2; ++row)
    for (int column = -2; column <= 2; ++column)
      made.bones.push_back(make_bone("ball " + std::to_string(row) + std::to_string(column),
                                     sphere_mesh(0.0008),
                                     Vec3(0.0022 * column, 0.0022 * row, -0.012)));
  return made;
}

/// How much a picture's neighbours differ: detail.
double detail_of(const Image& image) {
  double sum = 0;
  for (int y = 40; y < 120; ++y)
    for (int x = 40; x < 120; ++x)
      sum += std::abs(brightness(image, x, y) - brightness(image, x + 1, y));
  return sum;
}

TEST_F(ScopePictures, CloudyWaterAndFogTakeDetailAndBloodColoursIt) {
  const Case the_case = rows_of_balls();
  const ScopeCamera camera(wide_scope(0, 0.6), {});
  ScopeRenderer renderer = make_scope(the_case);
  const auto drawn = [&](const ScopeWater& water) {
    renderer.set_water(water);
    return renderer.draw_image(camera, 160, 160, RenderQuality::kFast);
  };
  const Image clear = drawn({});
  const Image cloudy = drawn({200, 0, 0}), bloody = drawn({200, 1, 0}), fogged = drawn({0, 0, 1});
  EXPECT_LT(detail_of(cloudy), 0.5 * detail_of(clear));
  EXPECT_LT(detail_of(fogged), 0.75 * detail_of(clear));
  EXPECT_GT(mean_channel(bloody, 0), 2 * mean_channel(bloody, 1));
  EXPECT_LT(mean_channel(cloudy, 0), 1.2 * mean_channel(cloudy, 1));
  // Numbers that are none are clear water.
  EXPECT_EQ(count_different(clear, drawn({std::nan(""), -1, -1}), 0), 0);
}

// What the tip lies in gives way where it is closed; an open surface is seen from both sides.
TEST_F(ScopePictures, AClosedPartIsNotSeenFromWithinAnOpenOneIsSeenFromBehind) {
  const ScopeCamera camera(wide_scope(0, 0.6), {});
  const auto drawn = [&](const Case& the_case) {
    return make_scope(the_case).draw_image(camera, 160, 160, RenderQuality::kFast);
  };
  const Case bare = lone_ball(Vec3(0, 0, -0.012), 0.004);
  const Image alone = drawn(bare);
  Case around = bare;
  SoftPart soft;
  soft.name = soft.kind = "ligament";
  soft.mesh_W = sphere_mesh(0.003);
  around.softs.push_back(soft);
  EXPECT_EQ(count_different(alone, drawn(around), 0), 0);
  TriMesh& mesh = around.softs[0].mesh_W;
  std::erase_if(mesh.triangles, [&](const Triangle& t) { return mesh.vertices[t[0]].z() > 0; });
  EXPECT_GT(count_different(alone, drawn(around), 20), 1000) << "a bowl before the tip";
}

WaterBit bit_at(WaterBit::Is is, const Vec3& p_W, double radius_m) {
  WaterBit bit;
  bit.is = is;
  bit.p_W = p_W;
  bit.radius_m = radius_m;
  return bit;
}

// Before a ball whose nearest point is 8 mm off: each is seen where it is projected and changes
// nothing elsewhere; behind the ball, or of no size, nothing is seen of it.
TEST_F(ScopePictures, BubblesAndFlakesAreSeenWhereTheyAre) {
  const Case the_case = lone_ball(Vec3(0, 0, -0.012), 0.004);
  const ScopeCamera camera(wide_scope(30, 0.6),
                           {Vec3::Zero(), -Vec3::UnitZ(), Vec3::UnitY(), 3.14159});
  ScopeRenderer renderer = make_scope(the_case);
  const auto drawn = [&](const std::vector<WaterBit>& bits) {
    renderer.set_water_bits(bits);
    return renderer.draw_image(camera, 240, 240, RenderQuality::kFast);
  };
  const Image clear = drawn({});
  for (const auto is : {WaterBit::Is::kBubble, WaterBit::Is::kFlake}) {
    const Vec3 at = camera.X_WC() * Vec3(0.0012, -0.0008, -0.006);
    const Image seen = drawn({bit_at(is, at, 0.0004)});
    const auto middle = camera.project({0, 0, 240, 240}, at);
    ASSERT_TRUE(middle);
    int near = 0, far = 0;
    for (int y = 0; y < 240; ++y)
      for (int x = 0; x < 240; ++x) {
        if (std::abs(brightness(clear, x, y) - brightness(seen, x, y)) < 12) continue;
        const bool is_near = std::hypot(x + 0.5 - middle->x, y + 0.5 - middle->y) < 16;
        ++(is_near ? near : far);
      }
    EXPECT_GT(near, 40) << static_cast<int>(is);
    EXPECT_EQ(far, 0) << static_cast<int>(is);
    const double nan = std::nan("");
    const Vec3 behind = Vec3(0, 0, -0.012);
    for (const WaterBit& none :
         {bit_at(is, behind, 0.0004), bit_at(is, Vec3(nan, 0, 0), 0.0004), bit_at(is, at, 0),
          bit_at(is, at, nan), bit_at(is, camera.X_WC() * Vec3(0, 0, 0.003), 0.0004)})
      EXPECT_EQ(count_different(clear, drawn({none}), 0), 0) << static_cast<int>(is);
  }
}

// A window's picture that stands still is drawn anew for them.
TEST_F(ScopePictures, WhatDriftsMakesAStillPictureNew) {
  const Case the_case = lone_ball(Vec3(0, 0, -0.012), 0.004);
  const ScopeCamera camera(wide_scope(0, 0.6), {});
  ScopeRenderer renderer = make_scope(the_case);
  RenderTarget screen;
  ASSERT_TRUE(screen.ensure(120, 120, 0));
  const auto painted = [&] {
    glBindFramebuffer(GL_FRAMEBUFFER, screen.framebuffer());
    EXPECT_TRUE(renderer.paint(camera, 120));
    renderer.show({0, 0, 120, 120});
    std::vector<std::uint8_t> rgb(3 * 120 * 120);
    glReadPixels(0, 0, 120, 120, GL_RGB, GL_UNSIGNED_BYTE, rgb.data());
    return rgb;
  };
  std::vector<std::uint8_t> still;
  for (int k = 0; k < 20; ++k) still = painted();
  const std::vector<WaterBit> bits = {bit_at(WaterBit::Is::kFlake, Vec3(0, 0, -0.006), 0.0006)};
  renderer.set_water_bits(bits);
  EXPECT_NE(painted(), still);
}

TEST_F(ScopePictures, AWarmLightIsOrangeUntilTheCameraIsBalancedToIt) {
  const Case the_case = rows_of_balls();
  const ScopeCamera camera(wide_scope(0, 0.6), {});
  ScopeRenderer renderer = make_scope(the_case);
  const auto drawn = [&](const WhiteBalance& white) {
    renderer.set_white_balance(white);
    return renderer.draw_image(camera, 160, 160, RenderQuality::kFast);
  };
  const Image usual = renderer.draw_image(camera, 160, 160, RenderQuality::kFast);
  const Image warm = drawn({3200, kScopeLamp_k}), balanced = drawn({3200, 3200});
  EXPECT_EQ(count_different(usual, balanced, 0), 0);
  const auto blue_of_red = [](const Image& image) {
    return mean_channel(image, 2) / mean_channel(image, 0);
  };
  EXPECT_LT(blue_of_red(warm), 0.8 * blue_of_red(usual));
  EXPECT_GT(blue_of_red(drawn({9000, kScopeLamp_k})), 1.1 * blue_of_red(usual));
}

// A ball of 6 mm whose nearest point is 6 mm before the tip: a plume between them reddens the
// picture where it is, one behind the ball does not.
TEST_F(ScopePictures, APlumeOfBloodIsSeenWhereItIs) {
  const Case the_case = lone_ball(Vec3(0, 0, -0.012), 0.006);
  const ScopeCamera camera(wide_scope(0, 0.6), {});
  ScopeRenderer renderer = make_scope(the_case);
  const auto drawn = [&](const BloodPlume& plume) {
    ScopeWater water;
    water.plume_count = 1;
    water.plumes[0] = plume;
    renderer.set_water(water);
    return renderer.draw_image(camera, 160, 160, RenderQuality::kFast);
  };
  const auto redness = [](const Image& image, int x, int y) {
    const auto rgb = pixel(image, x, y);
    return static_cast<double>(rgb[0]) / (rgb[1] + 1.0);
  };
  renderer.set_water({});
  const Image clear = renderer.draw_image(camera, 160, 160, RenderQuality::kFast);
  const double radius_m = 0.0005;
  const Image before = drawn({Vec3(0, 0, -0.004), radius_m, 1000});
  EXPECT_GT(redness(before, 80, 80), 1.5 * redness(clear, 80, 80));
  EXPECT_LT(redness(before, 80, 120), 1.1 * redness(clear, 80, 120)) << "beside it";
  const Image behind = drawn({Vec3(0, 0, -0.015), radius_m, 1000});
  EXPECT_NEAR(redness(behind, 80, 80), redness(clear, 80, 80), 0.05);
  const double nan = std::nan("");
  for (const BloodPlume& none :
       {BloodPlume{Vec3(nan, 0, 0), radius_m, 1000}, BloodPlume{Vec3::Zero(), nan, 1000},
        BloodPlume{Vec3::Zero(), 0, 1}, BloodPlume{Vec3::Zero(), radius_m, nan}})
    EXPECT_EQ(count_different(clear, drawn(none), 0), 0);
}

// A window's picture: of surfaces that another view has, copied to a place of the screen.
TEST_F(ScopePictures, AWindowShowsTheSamePictureOfSharedSurfaces) {
  const Case the_case = lone_ball(Vec3(0.001, 0, -0.012), 0.004);
  const ScopeCamera camera(wide_scope(0, 0.6), {});
  const Image alone = make_scope(the_case).draw_image(camera, 160, 160, RenderQuality::kFast);
  Renderer scene = make_renderer(the_case);
  auto made = ScopeRenderer::create(the_case, OSTEON_SOURCE_DIR, scene);
  ASSERT_TRUE(made) << made.error().message();
  EXPECT_EQ(count_different(alone, made->draw_image(camera, 160, 160, RenderQuality::kFast), 0), 0);
  RenderTarget screen;
  ASSERT_TRUE(screen.ensure(300, 200, 0));
  glBindFramebuffer(GL_FRAMEBUFFER, screen.framebuffer());
  glClearColor(0, 0, 1, 1);
  glClear(GL_COLOR_BUFFER_BIT);
  ASSERT_TRUE(made->paint(camera, 160));
  made->show({100, 20, 160, 160});
  const auto at = [](int x, int y) {
    std::array<std::uint8_t, 3> rgb{};
    glReadPixels(x, y, 1, 1, GL_RGB, GL_UNSIGNED_BYTE, rgb.data());
    return rgb;
  };
  EXPECT_EQ(at(99, 100), (std::array<std::uint8_t, 3>{0, 0, 255})) << "outside of the viewport";
  EXPECT_EQ(at(102, 22), (std::array<std::uint8_t, 3>{0, 0, 0})) << "outside of the field stop";
  const auto ball = at(180, 100);
  const auto same = pixel(alone, 80, 79);
  for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(ball[c], same[c], 12);
  EXPECT_GT(ball[0], 60);
  // An edited surface shows in both: here it is gone.
  scene.set_surface(BoneId{0}, sphere_mesh(1e-6));
  ASSERT_TRUE(made->paint(camera, 160));
  made->show({100, 20, 160, 160});
  EXPECT_LT(at(180, 100)[0], 10);
}

// A scope with surfaces of its own: another surface is seen in the place of the first.
TEST_F(ScopePictures, AnotherSurfaceIsSeenInItsPlace) {
  const ScopeCamera camera(wide_scope(0, 1), ScopePose{});
  const Vec3 at = camera.X_WC() * Vec3(0, 0, -0.02);
  ScopeRenderer renderer = make_scope(lone_ball(at, 0.003));
  const Spot large = bright_spot(renderer.draw_image(camera, 200, 200));
  renderer.set_surface(BoneId{0}, sphere_mesh(0.0015));
  const Spot small = bright_spot(renderer.draw_image(camera, 200, 200));
  ASSERT_GT(small.pixels, 50);
  EXPECT_NEAR(small.pixels, 0.25 * large.pixels, 0.05 * large.pixels);
  renderer.set_surface(BoneId{7}, sphere_mesh(0.010));  // of no part: nothing happens
  EXPECT_EQ(bright_spot(renderer.draw_image(camera, 200, 200)).pixels, small.pixels);
}

// Neither is a bone, though each has places in a frame of its own as a bone has: what is carved
// out of the first bone of a case leaves them as they were.
TEST_F(ScopePictures, ToolsAndTheWallAreNotLeftOutWhereABoneIsCarved) {
  const ScopeCamera camera(wide_scope(0, 1), ScopePose{});
  const Pose X_WC = camera.X_WC();
  const Case the_case = lone_ball(X_WC * Vec3(0, 0, 0.1), 0.002);  // behind the eye
  ScopeRenderer renderer = make_scope(the_case);
  TriMesh wall = sphere_mesh(0.02);
  for (Vec3& p : wall.vertices) p = X_WC * Vec3(p - Vec3(0, 0, 0.03));
  renderer.set_wall(wall);
  auto tool = std::make_shared<Tool>(make_wrist_probe());
  tool->mesh = sphere_mesh(0.002);
  const std::array<std::shared_ptr<const Tool>, 1> tray{tool};
  renderer.set_tray(tray);
  RenderSnapshot snapshot = at_rest(the_case);
  const auto picture = [&] { return renderer.draw_image(camera, 160, 160); };
  const Image wall_alone = picture();
  snapshot.tool.X_WP = {X_WC * Vec3(0.002, 0, -0.008), Quat::Identity()};
  renderer.set_scene(snapshot.bones, {&snapshot.tool, 1});
  const Image before = picture();
  ASSERT_GT(count_different(before, wall_alone, 20), 500) << "the tool is seen";
  ASSERT_GT(brightness(wall_alone, 80, 60), 20) << "the wall is";
  const CubeGrid everywhere{Vec3::Constant(-0.2), 0.4, {1, 1, 1}, 0};
  const SurfaceCube nothing_left;
  renderer.set_cubes(BoneId{0}, everywhere, {&nothing_left, 1});
  EXPECT_EQ(picture().rgb, before.rgb);
}

// A soft part that gives way and comes back looks as before.
TEST_F(ScopePictures, WhatGivesWayIsSeenAndComesBack) {
  const ScopeCamera camera(wide_scope(0, 1), ScopePose{});
  const Vec3 at = camera.X_WC() * Vec3(0, 0, -0.02);
  Case the_case = lone_ball(at + Vec3(0, 0, 0.1), 0.002);
  SoftPart soft;
  soft.name = soft.kind = "meniscus";
  soft.mesh_W = sphere_mesh(0.003);
  for (Vec3& p : soft.mesh_W.vertices) p += at;
  soft.bones = {BoneId{0}};
  the_case.softs.push_back(soft);
  ScopeRenderer renderer = make_scope(the_case);
  const Image rest = renderer.draw_image(camera, 200, 200);
  TriMesh moved = soft.mesh_W;
  for (Vec3& p : moved.vertices) p += 0.002 * (camera.X_WC().q * Vec3::UnitX());
  renderer.move_surface(BoneId{1}, soft.mesh_W, moved);
  const Image pressed = renderer.draw_image(camera, 200, 200);
  EXPECT_GT(bright_spot(pressed).x, bright_spot(rest).x + 3);
  renderer.move_surface(BoneId{1}, soft.mesh_W, soft.mesh_W);
  EXPECT_EQ(renderer.draw_image(camera, 200, 200).rgb, rest.rgb);
}

/// Share of red less that of blue in all pixels whose place on a disc has so large a share of its
/// half axes.
double warmth(const Image& image, const ScopeCamera& camera, const Vec3& half, double depth_m,
              double least, double most) {
  double sum = 0;
  int count = 0;
  for (double s = -1; s <= 1; s += 0.02)
    for (double t = -1; t <= 1; t += 0.02) {
      const double r = std::hypot(s, t);
      const auto at = camera.project({0, 0, image.width, image.height},
                                     Vec3(s * half.x(), t * half.y(), -depth_m));
      if (r < least || r > most || !at) continue;
      const auto k = 3 * (static_cast<std::size_t>(at->y) * static_cast<std::size_t>(image.width) +
                          static_cast<std::size_t>(at->x));
      const double red = image.rgb[k], blue = image.rgb[k + 2];
      sum += (red - blue) / (red + image.rgb[k + 1] + blue + 1);
      ++count;
    }
  return sum / count;
}

TEST_F(ScopePictures, ADiscHasAWarmRimAroundAPaleMiddleMoreThanAMeniscusHas) {
  const Vec3 half(0.008, 0.006, 0.0008);
  constexpr double kDepth_m = 0.013;
  const ScopeCamera camera(wide_scope(0, 0.6), {});
  const auto warmer_rim = [&](const std::string& kind) {
    Case the_case = lone_ball(Vec3(0, 0, -0.04), 0.002);
    SoftPart soft;
    soft.name = soft.kind = kind;
    soft.mesh_W = sphere_mesh(1);
    for (Vec3& v : soft.mesh_W.vertices) v = half.cwiseProduct(v) - Vec3(0, 0, kDepth_m);
    the_case.softs.push_back(soft);
    ScopeRenderer renderer = make_scope(the_case);
    const Image image = renderer.draw_image(camera, 300, 300);
    return warmth(image, camera, half, kDepth_m, 0.70, 0.92) -
           warmth(image, camera, half, kDepth_m, 0, 0.4);
  };
  EXPECT_GT(warmer_rim("disc"), 1.8 * warmer_rim("meniscus")) << "slopes are warmer on both";
}

TEST(JointRoom, ATipInBoneIsRefusedByName) {
  const Case the_case = lone_ball(Vec3(0.02, 0, 0), 0.01);
  const JointRoom room(the_case);
  BoneSnapshot bones = rest_snapshot(the_case);
  EXPECT_TRUE(room.wall(bones, Vec3(0.001, 0, 0)));
  bones.bones[0].X_WB.p = Vec3::Zero();
  const auto wall = room.wall(bones, Vec3(0.001, 0, 0));
  ASSERT_FALSE(wall);
  EXPECT_NE(wall.error().what.find("'ball'"), std::string::npos);
  EXPECT_FALSE(room.wall(bones, Vec3(0, 0, std::nan(""))));
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

TEST(JointWall, IsNearerWhereABoneIsSmall) {
  const MeshDistance ball(sphere_mesh(0.01)), pea(sphere_mesh(0.004));
  const std::string name = "ball";
  const WalledBone bones[] = {{&ball, {}, &name}, {&pea, {{0, 0, 0.02}, Quat::Identity()}, &name}};
  const auto farthest = [&](std::size_t count) {
    const auto wall = joint_wall({bones, count}, Vec3(0.011, 0, 0));
    double most = 0;
    if (wall)
      for (const Vec3& v : wall->vertices)
        if (v.z() < -0.01) most = std::max(most, v.norm());
    return most;
  };
  EXPECT_NEAR(farthest(1), 0.020, 0.001);
  EXPECT_NEAR(farthest(2), 0.0155, 0.001);
}

}  // namespace
}  // namespace osteon
