// Surfaces that change while they are drawn: carved, warmed, pressed.
#include <algorithm>
#include <cmath>

#include "gl_fixture.h"

namespace osteon {
namespace {

class ChangedSurfaces : public GlTest {};

// A cube of a grid shows what it was given in place of the bone's own surface, and no other does.
TEST_F(ChangedSurfaces, ChangedCubesShowInPlaceOfTheSurface) {
  const Case ball_case = one_ball(0.03);
  Renderer renderer = make_renderer(ball_case);
  ViewState view = front_view();
  view.show_proxy = false;
  ViewState without = view;
  without.bones.resize(1);
  without.bones[0].visible = false;
  const RenderSnapshot snapshot = at_rest(ball_case);
  const auto picture = [&](const ViewState& how) {
    return renderer.draw_image(snapshot, how, 200, 200);
  };
  const Image ground = picture(without), whole = picture(view);
  const CubeGrid grid{Vec3::Constant(-0.04), 0.08, {1, 1, 1}, 0};
  SurfaceCube cube;
  renderer.set_cubes(BoneId{0}, grid, {&cube, 1});
  EXPECT_EQ(picture(view).rgb, ground.rgb);
  cube = cube_with_ball(0.015, 0);
  renderer.set_cubes(BoneId{0}, grid, {&cube, 1});
  const int all = count_different(whole, ground, 40);
  EXPECT_NEAR(count_different(picture(view), ground, 40), 0.25 * all, 0.03 * all);
  // What was cut lies deep in the bone: it is darker.
  const Image flat = picture(view);
  cube.depth_m.assign(cube.vertices.size(), 0.015f);
  renderer.set_cubes(BoneId{0}, grid, {&cube, 1});
  EXPECT_LT(brightness(picture(view), 100, 100), brightness(flat, 100, 100));
  renderer.clear_cubes();
  EXPECT_EQ(picture(view).rgb, whole.rgb);
  // A grid beside the bone, and what makes no sense, change nothing.
  renderer.set_cubes(BoneId{0}, {Vec3::Constant(1), 0.08, {1, 1, 1}, 0}, {&cube, 1});
  renderer.set_cubes(BoneId{7}, grid, {&cube, 1});
  cube = {};
  renderer.clear_cubes();
  renderer.set_cubes(BoneId{0}, {Vec3::Constant(-0.04), -1, {1, 1, 1}, 0}, {&cube, 1});
  renderer.set_cubes(BoneId{0}, {Vec3::Constant(-0.04), 0.08, {0, 1, 1}, 0}, {&cube, 1});
  EXPECT_EQ(picture(view).rgb, whole.rgb);
}

// Of bone that is looked through, the surface that was there and the new one are not both seen
// where one goes over into the other.
TEST_F(ChangedSurfaces, OfClearBoneNoSeamIsSeenWhereANewSurfaceBegins) {
  constexpr double kOverlap_m = 0.008;
  const Case ball_case = one_ball(0.03);
  Renderer renderer = make_renderer(ball_case);
  ViewState view = front_view();
  view.show_proxy = false;
  view.bones.resize(1);
  view.bones[0].opacity = 0.4f;
  const RenderSnapshot snapshot = at_rest(ball_case);
  // The left half of the ball is new, and is as it was.
  const CubeGrid grid{Vec3(-0.04, -0.04, -0.04), 0.04, {2, 2, 2}, kOverlap_m};
  const TriMesh ball = sphere_mesh(0.03);
  std::vector<SurfaceCube> cubes(4);
  for (std::uint32_t k = 0; k < cubes.size(); ++k) cubes[k].cube = 2 * k;
  cubes[0].vertices = ball.vertices;
  for (const Triangle& t : ball.triangles)
    if (std::all_of(t.begin(), t.end(), [&](std::uint32_t v) { return ball.vertices[v].x() <= 0; }))
      cubes[0].triangles.push_back(t);
  renderer.set_cubes(BoneId{0}, grid, cubes);
  const Image picture = renderer.draw_image(snapshot, view, 200, 200);
  const Viewport viewport{0, 0, 200, 200};
  const auto at = [&](double x_m) {
    const auto place = project(view.camera, viewport, Vec3(x_m, 0, 0));
    EXPECT_TRUE(place);
    return brightness(picture, static_cast<int>(place->x), static_cast<int>(place->y));
  };
  const int inside = at(-0.5 * kOverlap_m), beyond = at(-1.5 * kOverlap_m);
  EXPECT_NEAR(inside, beyond, 25);
}

// A pointer meets what is left of a carved bone.
TEST_F(ChangedSurfaces, ACarvedBoneIsPickedAtItsCutSurface) {
  const Case ball_case = one_ball(0.03);
  Renderer renderer = make_renderer(ball_case);
  const ViewState view = front_view();
  const RenderSnapshot snapshot = at_rest(ball_case);
  const auto depth = [&](double x, double y) {
    const SurfacePoint p = renderer.pick_point(snapshot, view, {0, 0, 200, 200}, x, y);
    return p.bone.valid() ? p.p_W.norm() : 0;
  };
  EXPECT_NEAR(depth(100, 100), 0.03, 1e-4);
  const CubeGrid grid{Vec3::Constant(-0.04), 0.08, {1, 1, 1}, 0};
  SurfaceCube cube;
  renderer.set_cubes(BoneId{0}, grid, {&cube, 1});
  EXPECT_EQ(depth(100, 100), 0);  // nothing is left
  const TriMesh smaller = sphere_mesh(0.015);
  cube.vertices = smaller.vertices;
  cube.triangles = smaller.triangles;
  renderer.set_cubes(BoneId{0}, grid, {&cube, 1});
  EXPECT_NEAR(depth(100, 100), 0.015, 1e-4);
  // Half of the grid's cubes: beyond them the bone is as it was.
  renderer.clear_cubes();
  EXPECT_NEAR(depth(100, 100), 0.03, 1e-4);
  renderer.set_cubes(BoneId{0}, {Vec3(1, 1, 1), 0.08, {1, 1, 1}, 0}, {&cube, 1});
  EXPECT_GT(depth(100, 100), 0.014);
  renderer.clear_cubes();
  renderer.set_cubes(BoneId{7}, grid, {&cube, 1});
  renderer.set_cubes(BoneId{0}, {Vec3::Constant(-0.04), -1, {1, 1, 1}, 0}, {&cube, 1});
  EXPECT_NEAR(depth(100, 100), 0.03, 1e-4);
}

// Bone is coloured where it was warm, and only where that is asked for.
TEST_F(ChangedSurfaces, WarmBoneIsColouredByItsHottestTemperature) {
  const Case ball_case = one_ball(0.03);
  Renderer renderer = make_renderer(ball_case);
  ViewState view = front_view();
  view.show_proxy = false;
  const RenderSnapshot snapshot = at_rest(ball_case);
  const auto picture = [&] { return renderer.draw_image(snapshot, view, 200, 200); };
  const Image plain = picture();
  view.show_heat = true;
  EXPECT_EQ(picture().rgb, plain.rgb);  // nothing was warm
  HeatCells heat{Vec3::Constant(-0.035), 0.01, {8, 8, 8}, {}};
  heat.cells.assign(512, {0, 0});
  renderer.set_heat(BoneId{0}, heat);
  EXPECT_EQ(picture().rgb, plain.rgb);
  const auto byte = [](double celsius) {
    return static_cast<std::uint8_t>(255 * (celsius - HeatCells::kFrom_c) /
                                     (HeatCells::kTo_c - HeatCells::kFrom_c));
  };
  // Of the pixel in the middle: how much redder, and how much bluer, than it is green.
  const auto tint = [&](const Image& image) {
    const std::size_t at = 3 * (100 * 200 + 100);
    return std::pair(image.rgb[at] - image.rgb[at + 1], image.rgb[at + 2] - image.rgb[at + 1]);
  };
  heat.cells.assign(512, {byte(50), 0});
  renderer.set_heat(BoneId{0}, heat);
  const Image hot = picture();
  EXPECT_GT(tint(hot).first, tint(plain).first + 60);
  heat.cells.assign(512, {byte(50), 255});
  renderer.set_heat(BoneId{0}, heat);
  EXPECT_GT(tint(picture()).second, tint(hot).second + 20);  // dead bone is violet
  // What was cut is coloured too, and the rest of the surface still left out.
  const CubeGrid grid{Vec3::Constant(-0.04), 0.08, {1, 1, 1}, 0};
  const SurfaceCube cube = cube_with_ball(0.015, 0);
  renderer.set_cubes(BoneId{0}, grid, {&cube, 1});
  EXPECT_GT(tint(picture()).second, tint(hot).second + 20);
  view.show_heat = false;
  const Image carved = picture();
  view.show_heat = true;
  EXPECT_GT(count_different(picture(), carved, 20), 500);
  // Nonsense is as if it was never warm; so is a run that begins anew.
  heat.cell_m = -1;
  renderer.set_heat(BoneId{0}, heat);
  EXPECT_EQ(picture().rgb, carved.rgb);
  heat.cell_m = 0.01;
  renderer.set_heat(BoneId{0}, heat);
  renderer.set_heat(BoneId{7}, heat);
  renderer.clear_cubes();
  EXPECT_EQ(picture().rgb, plain.rgb);
}

// The point under a pixel lies on the ball; after another surface is set, so does what is drawn.
TEST_F(ChangedSurfaces, AnotherSurfaceIsShownAndPicked) {
  const Case one = one_ball(0.03);
  Renderer renderer = make_renderer(one);
  const RenderSnapshot snapshot = at_rest(one);
  ViewState view = front_view();
  view.show_proxy = false;
  const Viewport viewport{0, 0, 64, 64};
  const auto edge = project(view.camera, viewport, Vec3(0.02, 0, 0));
  const auto middle = project(view.camera, viewport, Vec3::Zero());
  ASSERT_TRUE(edge && middle);
  const SurfacePoint before =
      renderer.pick_point(snapshot, view, viewport, middle->x + 2, middle->y + 3);
  ASSERT_EQ(before.bone.index, 0u);
  EXPECT_NEAR(before.p_W.norm(), 0.03, 3e-4);
  EXPECT_TRUE(renderer.pick(snapshot, view, viewport, edge->x, edge->y).valid());
  const Image large = renderer.draw_image(snapshot, view, 64, 64);
  renderer.set_surface(BoneId{0}, sphere_mesh(0.01));
  renderer.set_surface(BoneId{}, sphere_mesh(0.01));  // of no bone: nothing happens
  EXPECT_FALSE(renderer.pick(snapshot, view, viewport, edge->x, edge->y).valid());
  EXPECT_NEAR(renderer.pick_point(snapshot, view, viewport, middle->x, middle->y).p_W.norm(), 0.01,
              1e-4);
  const Image small = renderer.draw_image(snapshot, view, 64, 64);
  const int x = static_cast<int>(edge->x), y = static_cast<int>(edge->y);
  EXPECT_GT(brightness(large, x, y), brightness(small, x, y) + 20);
}

// A soft part between two bones lies in their shade. What gives way stays in it; a plain surface
// does not.
TEST_F(ChangedSurfaces, WhatGivesWayKeepsItsLight) {
  Case the_case;
  for (const double side : {-1.0, 1.0})
    the_case.bones.push_back(
        make_bone(side < 0 ? "left" : "right", sphere_mesh(0.012), Vec3(side * 0.0155, 0, 0)));
  SoftPart soft;
  soft.name = soft.kind = "meniscus";
  soft.mesh_W = sphere_mesh(0.003);
  soft.bones = {BoneId{0}};
  the_case.softs.push_back(soft);
  Renderer renderer = make_renderer(the_case);
  ViewState view = front_view();
  view.camera.distance_m = 0.1;
  view.softs.resize(1);
  view.show_proxy = false;
  RenderSnapshot snapshot;
  snapshot.bones = rest_snapshot(the_case);
  const auto look = [&] { return renderer.draw_image(snapshot, view, 200, 200); };
  constexpr int kLighter = 30;
  const Image rest = look();
  renderer.set_surface(BoneId{2}, soft.mesh_W);
  const int plain = count_different(rest, look(), kLighter);
  EXPECT_GT(plain, 50);
  renderer.move_surface(BoneId{2}, soft.mesh_W, soft.mesh_W);
  EXPECT_LT(count_different(rest, look(), kLighter), 10);
  TriMesh moved = soft.mesh_W;
  for (Vec3& p : moved.vertices) p.y() += 0.00005;
  renderer.move_surface(BoneId{2}, soft.mesh_W, moved);
  EXPECT_LT(count_different(rest, look(), kLighter), plain / 4);
}

}  // namespace
}  // namespace osteon
