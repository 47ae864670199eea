#include "osteon/render/renderer.h"

#include <cmath>
#include <limits>
#include <set>

#include "gl_fixture.h"
#include "graft_bench_case.h"

#include "osteon/base/turn.h"

namespace osteon {
namespace {

Case ball_with_hull(double radius_m) {
  Case one = one_ball(radius_m);
  one.bones[0].pieces.push_back(cube_hull(radius_m));
  return one;
}

Tool stick(double radius_m, double length_m) {
  Tool tool;
  tool.mesh = cylinder(24);
  for (Vec3& p : tool.mesh.vertices) p = Vec3(radius_m * p.x(), radius_m * p.y(), length_m * p.z());
  tool.tip_radius_m = radius_m;
  return tool;
}

class RendererTest : public GlTest {};

TEST_F(RendererTest, ErrorNamesTheMissingShaderFolder) {
  const auto renderer = Renderer::create(Case{}, Tool{}, "/nowhere");
  ASSERT_FALSE(renderer.has_value());
  EXPECT_NE(renderer.error().message().find("/nowhere"), std::string::npos);
}

TEST_F(RendererTest, AnotherViewHasTheSameSurfacesAndMarksOfItsOwn) {
  const Case ball_case = one_ball(0.03);
  Renderer one = make_renderer(ball_case);
  Renderer two = one.another_view();
  const auto picture = [&](Renderer& renderer) {
    return renderer.draw_image(at_rest(ball_case), front_view(), 64, 64);
  };
  const Image before = picture(one);
  EXPECT_EQ(before.rgb, picture(two).rgb);
  const SolidMark mark{sphere_mesh(0.05), {1, 0, 0, 1}};
  two.set_marks({&mark, 1});
  EXPECT_GT(count_different(before, picture(two), 30), 100);
  EXPECT_EQ(before.rgb, picture(one).rgb) << "marks are one view's own";
  two.set_marks({});
  one.set_surface(BoneId{0}, sphere_mesh(0.015));
  EXPECT_GT(count_different(before, picture(one), 30), 100);
  EXPECT_EQ(picture(one).rgb, picture(two).rgb) << "a surface is of both";
}

// A pin that stays in a bone is drawn where it stands, and its line through the bone.
TEST_F(RendererTest, APinAndItsLineAreDrawnInTheBone) {
  const Case ball_case = one_ball(0.03);
  Renderer renderer = make_renderer(ball_case);
  RenderSnapshot snapshot = at_rest(ball_case);
  const Image without = renderer.draw_image(snapshot, front_view(), 200, 200);
  // Out of the ball to the right, its inner end in the middle.
  GuideRod& pin = snapshot.bones.rods[0];
  pin = {GuideRod::Kind::kPin, 0, {}, 0.002, 0.06, 0.03};
  pin.X_BR.q = turn_between(Vec3::UnitZ(), Vec3(Vec3::UnitX()));
  const Image with = renderer.draw_image(snapshot, front_view(), 200, 200);
  const auto changed = [&](double x_m) {
    // The middle is at 100; the ball's outline tells how far a metre reaches.
    int edge = 100;
    while (edge < 199 && brightness(without, edge + 1, 100) > 150) ++edge;
    const int x = 100 + static_cast<int>(std::lround((edge - 100) * x_m / 0.03));
    int most = 0;
    for (int y = 97; y <= 103; ++y)
      for (std::size_t c = 0; c < 3; ++c) {
        const std::size_t at =
            3 * (static_cast<std::size_t>(y) * 200 + static_cast<std::size_t>(x)) + c;
        most = std::max(most, std::abs(int{with.rgb[at]} - int{without.rgb[at]}));
      }
    return most;
  };
  EXPECT_GT(changed(0.045), 60) << "steel before the bone";
  EXPECT_GT(changed(0.015), 30) << "the line is seen through the bone";
  EXPECT_GT(changed(-0.015), 30) << "and goes on";
  // An aimer's sleeve is drawn likewise, until a graft lies in the tunnels.
  pin.kind = GuideRod::Kind::kSleeve;
  EXPECT_NE(renderer.draw_image(snapshot, front_view(), 200, 200).rgb, without.rgb);
  snapshot.bones.placing.on = true;
  EXPECT_EQ(renderer.draw_image(snapshot, front_view(), 200, 200).rgb, without.rgb);
  snapshot.bones.placing.on = false;
  pin = {};
  EXPECT_EQ(renderer.draw_image(snapshot, front_view(), 200, 200).rgb, without.rgb);
}

// What stands for the graft gives way to what was made of the tendons.
TEST_F(RendererTest, TendonsAndGraftAreDrawnAtTheirBench) {
  const auto bench = testing::bench_case();
  ASSERT_TRUE(bench);
  Renderer renderer = make_renderer(*bench);
  RenderSnapshot snapshot = at_rest(*bench);
  ViewState view = front_view();
  view.camera.distance_m = 0.9;
  const auto picture = [&] { return renderer.draw_image(snapshot, view, 200, 200); };
  const Image as_built = picture();
  snapshot.bones.bench.on = true;
  const Image begun = picture();
  EXPECT_GT(count_different(as_built, begun, 30), 20) << "no graft yet, and tendons on the thigh";
  snapshot.bones.bench.tendons[0].stripped = true;
  const Image stripped = picture();
  EXPECT_GT(count_different(begun, stripped, 30), 20);
  snapshot.bones.bench = testing::folded_bench(2, 2);
  EXPECT_GT(count_different(stripped, picture(), 30), 20);
  snapshot.bones.bench = {};
  EXPECT_EQ(picture().rgb, as_built.rgb);
}

TEST_F(RendererTest, EmptyCaseGivesGroundThatIsDarkAndLighterAbove) {
  const Case nothing;
  Renderer renderer = make_renderer(nothing);
  const Image image = renderer.draw_image(at_rest(nothing), front_view(), 64, 64);
  ASSERT_EQ(image.rgb.size(), 64u * 64u * 3u);
  EXPECT_LT(brightness(image, 32, 32), 150);
  EXPECT_GT(brightness(image, 32, 2), brightness(image, 32, 61) + 10);
}

TEST_F(RendererTest, SilhouetteOfABallHasTheSizeOfTheProjection) {
  const double radius = 0.03;
  const Case ball_case = one_ball(radius);
  Renderer renderer = make_renderer(ball_case);
  for (const RenderQuality quality : {RenderQuality::kFast, RenderQuality::kFine}) {
    for (const bool orthographic : {false, true}) {
      ViewState view = front_view(quality);
      view.camera.orthographic = orthographic;
      view.show_proxy = false;
      ViewState without = view;
      without.bones.resize(1);
      without.bones[0].visible = false;
      const RenderSnapshot snapshot = at_rest(ball_case);
      const Image image = renderer.draw_image(snapshot, view, 300, 200);
      const Image ground = renderer.draw_image(snapshot, without, 300, 200);
      const double d = view.camera.distance_m;
      const double tangent =
          orthographic ? radius / d : radius / std::sqrt(d * d - radius * radius);
      const double pixels = tangent / std::tan(0.5 * view.camera.vertical_fov_rad) * 100;
      const double area = 3.14159265 * pixels * pixels;
      EXPECT_NEAR(count_different(image, ground, 40), area, 0.03 * area);
    }
  }
}

TEST_F(RendererTest, FormReads) {
  const Case ball_case = one_ball(0.03);
  Renderer renderer = make_renderer(ball_case);
  ViewState view = front_view();
  view.show_proxy = false;
  const Image image = renderer.draw_image(at_rest(ball_case), view, 256, 256);
  // The key light stands above on the left.
  EXPECT_GT(brightness(image, 118, 112), brightness(image, 150, 152) + 60);
  // Warm: red above blue.
  const auto lit = pixel(image, 118, 112);
  EXPECT_GT(lit[0], lit[2] + 10);
  std::set<std::array<int, 3>> colors;
  for (int k = 100; k < 156; ++k) colors.insert(pixel(image, k, k));
  EXPECT_GT(colors.size(), 20u);
}

TEST_F(RendererTest, LightFollowsItsSettings) {
  const Case ball_case = one_ball(0.03);
  Renderer renderer = make_renderer(ball_case);
  ViewState view = front_view();
  view.show_proxy = false;
  view.light_azimuth_rad = 0.9;
  const Image right = renderer.draw_image(at_rest(ball_case), view, 256, 256);
  EXPECT_GT(brightness(right, 150, 112), brightness(right, 106, 112) + 60);
  view.light_brightness = 0.3f;
  const Image dim = renderer.draw_image(at_rest(ball_case), view, 256, 256);
  EXPECT_LT(brightness(dim, 150, 112), brightness(right, 150, 112) - 100);
}

TEST_F(RendererTest, OcclusionDarkensTheJointSpaceAndCanBeSwitchedOff) {
  Case pair;
  pair.bones.push_back(make_bone("left", sphere_mesh(0.01), Vec3(-0.0102, 0, 0)));
  pair.bones.push_back(make_bone("right", sphere_mesh(0.01), Vec3(0.0102, 0, 0)));
  Renderer renderer = make_renderer(pair);
  ViewState view = front_view();
  view.camera.distance_m = 0.1;
  view.light_azimuth_rad = 0;
  view.show_proxy = false;
  const Image with = renderer.draw_image(at_rest(pair), view, 256, 256);
  view.ambient_occlusion = 0;
  const Image without = renderer.draw_image(at_rest(pair), view, 256, 256);
  const int near_gap = 128 + 10;
  EXPECT_LT(brightness(with, near_gap, 128), brightness(without, near_gap, 128) - 60);
  const int outer = 128 + 80;
  EXPECT_NEAR(brightness(with, outer, 128), brightness(without, outer, 128), 12);
}

TEST_F(RendererTest, NearBonesHideFarOnes) {
  Case pair = one_ball(0.02);
  pair.bones.push_back(make_bone("red", sphere_mesh(0.02), Vec3(0, 0, -0.1)));
  Renderer renderer = make_renderer(pair);
  ViewState view = front_view();
  view.show_proxy = false;
  view.bones.resize(2);
  view.bones[1].color = {1, 0, 0};
  const auto front = pixel(renderer.draw_image(at_rest(pair), view, 99, 99), 49, 49);
  EXPECT_GT(front[1], 90);
  view.bones[0].opacity = 0.4f;
  const auto through = pixel(renderer.draw_image(at_rest(pair), view, 99, 99), 49, 49);
  EXPECT_LT(through[1], front[1] - 30);
  EXPECT_GT(through[1], 10);
  view.bones[0].visible = false;
  const auto bare = pixel(renderer.draw_image(at_rest(pair), view, 99, 99), 49, 49);
  EXPECT_LT(bare[1], through[1] - 10);
  EXPECT_GT(bare[0], 90);
}

TEST_F(RendererTest, TwoClearBonesMixInTheOrderOfTheirDepth) {
  Case pair = one_ball(0.02, Vec3(0, 0, 0.05));
  pair.bones.push_back(make_bone("far", sphere_mesh(0.02), Vec3(0, 0, -0.05)));
  Renderer renderer = make_renderer(pair);
  ViewState view = front_view();
  view.show_proxy = false;
  view.bones.resize(2);
  view.bones[0].color = {1, 0, 0};
  view.bones[1].color = {0, 1, 0};
  for (BoneAppearance& look : view.bones) look.opacity = 0.6f;
  const auto from_front = pixel(renderer.draw_image(at_rest(pair), view, 99, 99), 49, 49);
  EXPECT_GT(from_front[0], from_front[1]);
  EXPECT_GT(from_front[1], 30);
  view.camera = orbit(view.camera, Vec3::UnitY(), 3.14159265, 0);
  const auto from_behind = pixel(renderer.draw_image(at_rest(pair), view, 99, 99), 49, 49);
  EXPECT_GT(from_behind[1], from_behind[0]);
}

TEST_F(RendererTest, HighlightDrawsAnAccentAroundTheBone) {
  const Case ball_case = one_ball(0.02);
  Renderer renderer = make_renderer(ball_case);
  ViewState view = front_view();
  view.show_proxy = false;
  view.bones.resize(1);
  const Image plain = renderer.draw_image(at_rest(ball_case), view, 200, 200);
  view.bones[0].highlighted = true;
  const Image marked = renderer.draw_image(at_rest(ball_case), view, 200, 200);
  int bluer = 0;
  for (int x = 0; x < 200; ++x) {
    const auto a = pixel(plain, x, 100), b = pixel(marked, x, 100);
    if (b[2] - b[0] > 60 && b[2] - b[0] > a[2] - a[0] + 60) ++bluer;
  }
  EXPECT_GE(bluer, 3);
  EXPECT_LE(bluer, 14);
}

TEST_F(RendererTest, HullsAreAnOverlay) {
  const Case with_hull = ball_with_hull(0.02);
  Renderer renderer = make_renderer(with_hull);
  ViewState view = front_view();
  view.show_proxy = false;
  const Image off = renderer.draw_image(at_rest(with_hull), view, 200, 200);
  view.show_hulls = true;
  const Image on = renderer.draw_image(at_rest(with_hull), view, 200, 200);
  // The cube's silhouette is a square around the ball's disc; only the overlay covers its corner.
  const auto corner = project(view.camera, {0, 0, 200, 200}, Vec3(-0.018, 0.018, 0.02));
  ASSERT_TRUE(corner.has_value());
  const int x = static_cast<int>(corner->x), y = static_cast<int>(corner->y);
  EXPECT_GT(std::abs(brightness(on, x, y) - brightness(off, x, y)), 15);
  EXPECT_GT(brightness(on, 100, 100), 150);  // the bone still shows through
  EXPECT_EQ(pixel(on, 3, 3), pixel(off, 3, 3));
}

TEST_F(RendererTest, ProbeGhostAndForceAreDrawnWhenAsked) {
  const Case ball_case = one_ball(0.01);
  Renderer renderer = make_renderer(ball_case, stick(0.001, 0.06));
  RenderSnapshot snapshot = at_rest(ball_case);
  snapshot.tool.X_WP = {Vec3(0, 0.0105, 0), Quat(Eigen::AngleAxisd(1.0, Vec3::UnitY()))};
  snapshot.tool.X_WD = snapshot.tool.X_WP;
  ViewState view = front_view();
  view.show_proxy = view.show_force = view.show_hand_ghost = false;
  const auto shot = [&] { return renderer.draw_image(snapshot, view, 256, 256); };
  const Image bare = shot();
  view.show_proxy = true;
  const Image proxy = shot();
  EXPECT_GT(count_different(bare, proxy, 40), 100);
  view.show_hand_ghost = true;
  EXPECT_EQ(count_different(proxy, shot(), 10), 0) << "hand and proxy agree: no ghost";
  snapshot.tool.X_WD.p.y() -= 0.01;
  const Image ghost = shot();
  EXPECT_GT(count_different(proxy, ghost, 20), 100);
  view.show_force = true;
  EXPECT_EQ(count_different(ghost, shot(), 10), 0) << "no force: no arrow";
  snapshot.tool.force_W = Vec3(0, 2, 0);
  EXPECT_GT(count_different(ghost, shot(), 60), 40);
}

TEST_F(RendererTest, ForceArrowIsTenMillimetresLongForEachNewton) {
  const Case nothing;
  Renderer renderer = make_renderer(nothing);
  RenderSnapshot snapshot;
  snapshot.tool.force_W = Vec3(0, 3, 0);
  snapshot.tool.contact_count = 1;
  snapshot.tool.contacts[0].p_W = Vec3(0, -0.02, 0);
  ViewState view = front_view();
  const Viewport viewport{0, 0, 400, 400};
  const Image image = renderer.draw_image(snapshot, view, 400, 400);
  int top = 400, bottom = 0;
  for (int y = 0; y < 400; ++y) {
    const auto p = pixel(image, 200, y);
    if (p[0] < 140 || p[2] > 120) continue;  // amber
    top = std::min(top, y);
    bottom = std::max(bottom, y);
  }
  const double tip = project(view.camera, viewport, Vec3(0, 0.01, 0))->y;
  const double foot = project(view.camera, viewport, Vec3(0, -0.02, 0))->y;
  EXPECT_NEAR(top, tip, 3);
  EXPECT_NEAR(bottom, foot, 5);
}

TEST_F(RendererTest, SamePixelsForTheSameInput) {
  const Case hand = ball_hand(Vec3::UnitY(), Vec3::UnitZ(), -Vec3::UnitX());
  Renderer first = make_renderer(hand, stick(0.001, 0.05));
  Renderer second = make_renderer(hand, stick(0.001, 0.05));
  const ViewState view = default_view(hand);
  const Image a = first.draw_image(at_rest(hand), view, 320, 180);
  EXPECT_EQ(a.rgb, first.draw_image(at_rest(hand), view, 320, 180).rgb);
  EXPECT_EQ(a.rgb, second.draw_image(at_rest(hand), view, 320, 180).rgb);
}

TEST_F(RendererTest, ALargePictureOfTilesHasNoSeams) {
  const Case ball_case = one_ball(0.03);
  Renderer renderer = make_renderer(ball_case);
  ViewState view = front_view();
  view.show_proxy = false;
  const Image large = renderer.draw_image(at_rest(ball_case), view, 1100, 1060);
  const Viewport viewport{0, 0, 1100, 1060};
  const PixelPoint middle = *project(view.camera, viewport, Vec3::Zero());
  EXPECT_GT(brightness(large, static_cast<int>(middle.x), static_cast<int>(middle.y)), 200);
  // Neighbours across the seams (column 1024 from the left, row 1024 from the bottom).
  for (int k = 0; k < 1000; k += 7) {
    EXPECT_NEAR(brightness(large, 1023, k), brightness(large, 1024, k), 9);
    EXPECT_NEAR(brightness(large, k, 35), brightness(large, k, 36), 9);
  }
}

TEST_F(RendererTest, DegenerateSizesAndSnapshots) {
  const Case ball_case = one_ball(0.02);
  Renderer renderer = make_renderer(ball_case);
  const ViewState view = front_view();
  RenderSnapshot snapshot = at_rest(ball_case);
  EXPECT_EQ(renderer.draw_image(snapshot, view, 1, 1).rgb.size(), 3u);
  EXPECT_EQ(renderer.draw_image(snapshot, view, 0, -5).rgb.size(), 3u);
  renderer.draw(snapshot, view, {0, 0, 0, 0});
  renderer.draw(snapshot, view, {0, 0, -1, 20});

  ViewState hidden = view;
  hidden.bones.resize(1);
  hidden.bones[0].visible = false;
  const Image ground = renderer.draw_image(snapshot, hidden, 50, 50);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  snapshot.bones.bones[0].X_WB.p.x() = nan;
  snapshot.tool.X_WP.p.y() = nan;
  snapshot.tool.X_WD.q.w() = nan;
  snapshot.tool.force_W = Vec3(nan, 0, 0);
  snapshot.tool.contact_count = 4'000'000'000u;
  snapshot.tool.contacts[3].p_W.z() = nan;
  ViewState no_marks = view;
  no_marks.show_force = false;
  EXPECT_EQ(renderer.draw_image(snapshot, no_marks, 50, 50).rgb, ground.rgb);
  renderer.draw_image(snapshot, view, 50, 50);
  snapshot.bones.count = 4'000'000'000u;
  renderer.draw_image(snapshot, view, 50, 50);
}

TEST_F(RendererTest, CameraAmongTheBonesOrFarAwayDoesNoHarm) {
  const Case ball_case = one_ball(0.02);
  Renderer renderer = make_renderer(ball_case);
  for (const double distance_m : {1e-4, 0.02, 20.0}) {
    for (const bool orthographic : {false, true}) {
      ViewState view = front_view();
      view.camera.distance_m = distance_m;
      view.camera.orthographic = orthographic;
      EXPECT_FALSE(renderer.draw_image(at_rest(ball_case), view, 40, 40).rgb.empty());
    }
  }
}

TEST_F(RendererTest, DrawStaysInsideItsViewport) {
  const Case ball_case = one_ball(0.5);  // covers everything
  Renderer renderer = make_renderer(ball_case);
  GLuint color = 0, framebuffer = 0;
  glGenRenderbuffers(1, &color);
  glBindRenderbuffer(GL_RENDERBUFFER, color);
  glRenderbufferStorage(GL_RENDERBUFFER, GL_RGBA8, 64, 64);
  glGenFramebuffers(1, &framebuffer);
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
  glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, color);
  for (const RenderQuality quality : {RenderQuality::kFast, RenderQuality::kFine}) {
    glClearColor(1, 0, 1, 1);
    glClear(GL_COLOR_BUFFER_BIT);
    ViewState view = front_view(quality);
    view.camera.distance_m = 1;
    renderer.draw(at_rest(ball_case), view, {16, 8, 20, 30});
    GLint bound = 0;
    glGetIntegerv(GL_FRAMEBUFFER_BINDING, &bound);
    EXPECT_EQ(static_cast<GLuint>(bound), framebuffer);
    std::vector<std::uint8_t> p(64 * 64 * 4);
    glReadPixels(0, 0, 64, 64, GL_RGBA, GL_UNSIGNED_BYTE, p.data());
    for (std::size_t k = 0; k < p.size(); k += 4) {
      const std::size_t x = k / 4 % 64, y = k / 4 / 64;
      const bool inside = x >= 16 && x < 36 && y >= 8 && y < 38;
      const bool untouched = p[k] == 255 && p[k + 1] == 0 && p[k + 2] == 255;
      ASSERT_EQ(untouched, !inside) << x << ", " << y;
    }
  }
  glDeleteFramebuffers(1, &framebuffer);
  glDeleteRenderbuffers(1, &color);
}

TEST_F(RendererTest, PickAgreesWithTheClosedForm) {
  const double radius = 0.02;
  Case pair = one_ball(radius);
  pair.bones.push_back(make_bone("behind", sphere_mesh(0.04), Vec3(0, 0, -0.2)));
  const Renderer renderer = make_renderer(pair);
  RenderSnapshot snapshot = at_rest(pair);
  snapshot.bones.bones[0].X_WB = {Vec3(0.01, 0, 0), Quat(Eigen::AngleAxisd(1, Vec3::UnitX()))};
  ViewState view = front_view();
  view.bones.resize(2);
  const Viewport viewport{0, 0, 300, 200};
  const auto hits = [&](const Ray& ray, const Vec3& center, double r) {
    return (center - ray.origin_W).cross(ray.dir_W).norm() - r;
  };
  for (int x = 0; x < 300; x += 3) {
    for (int y = 0; y < 200; y += 3) {
      const Ray ray = ray_through(view.camera, viewport, x, y);
      const double first = hits(ray, Vec3(0.01, 0, 0), radius);
      const double second = hits(ray, Vec3(0, 0, -0.2), 0.04);
      if (std::min(std::abs(first), std::abs(second)) < 1e-4) continue;  // a mesh is not round
      const std::uint32_t expected = first < 0 ? 0u : second < 0 ? 1u : BoneId::kNone;
      ASSERT_EQ(renderer.pick(snapshot, view, viewport, x, y).index, expected);
    }
  }
  const PixelPoint at = *project(view.camera, viewport, Vec3(0.01, 0, 0));
  view.bones[0].visible = false;
  EXPECT_EQ(renderer.pick(snapshot, view, viewport, at.x, at.y).index, 1u);
  EXPECT_FALSE(renderer.pick(snapshot, view, viewport, -5, 10).valid());
  EXPECT_FALSE(renderer.pick(snapshot, view, {0, 0, 0, 0}, 0, 0).valid());
}

TEST_F(RendererTest, NamesItsDevice) {
  const Renderer renderer = make_renderer(Case{});
  EXPECT_FALSE(renderer.device_name().empty());
}

TEST_F(RendererTest, PiecesOfOneBoneHaveColoursOfTheirOwn) {
  Case pair;
  TriMesh wall;  // behind the pieces
  wall.vertices = {{-0.1, -0.1, -0.03}, {0.1, -0.1, -0.03}, {0, 0.1, -0.03}};
  wall.triangles = {{0, 1, 2}};
  Bone bone = make_bone("stone", std::move(wall), Vec3::Zero());
  for (const double x : {-0.02, 0.02}) {
    Hull piece = cube_hull(0.012);
    for (Vec3& p : piece.vertices) p.x() += x;
    for (Plane& plane : piece.planes) plane.d += plane.n.x() * x;
    bone.pieces.push_back(std::move(piece));
  }
  pair.bones.push_back(std::move(bone));
  Renderer renderer = make_renderer(pair);
  ViewState view = front_view();
  view.show_hulls = true;
  const Image image = renderer.draw_image(at_rest(pair), view, 300, 200);
  const auto [lr, lg, lb] = pixel(image, 120, 95);
  const auto [rr, rg, rb] = pixel(image, 180, 95);
  EXPECT_GT(std::abs(lr - rr) + std::abs(lg - rg) + std::abs(lb - rb), 20);
}

}  // namespace
}  // namespace osteon
