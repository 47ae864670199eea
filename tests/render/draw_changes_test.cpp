// A picture of which only the changed parts were drawn must be the one that is drawn whole.
#include <algorithm>
#include <cmath>
#include <cstring>

#include "gl_fixture.h"
#include "osteon/base/random.h"
#include "osteon/base/turn.h"

namespace osteon {
namespace {

constexpr int kWidth = 480, kHeight = 320;

class DrawChanges : public GlTest {
 protected:
  void SetUp() override {
    GlTest::SetUp();
    if (IsSkipped()) return;
    glGenFramebuffers(1, &framebuffer_);
    glGenTextures(1, &texture_);
    glBindTexture(GL_TEXTURE_2D, texture_);
    glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, kWidth, kHeight, 0, GL_RGBA, GL_UNSIGNED_BYTE,
                 nullptr);
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_);
    glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, texture_, 0);
  }
  void TearDown() override {
    glDeleteFramebuffers(1, &framebuffer_);
    glDeleteTextures(1, &texture_);
    GlTest::TearDown();
  }

  static Image drawn(Renderer& renderer, const RenderSnapshot& snapshot, const ViewState& view) {
    renderer.draw(snapshot, view, {0, 0, kWidth, kHeight});
    Image image{kWidth, kHeight, {}};
    image.rgb.resize(3u * kWidth * kHeight);
    std::vector<std::uint8_t> rows(image.rgb.size());
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
    glReadPixels(0, 0, kWidth, kHeight, GL_RGB, GL_UNSIGNED_BYTE, rows.data());
    for (std::size_t y = 0; y < kHeight; ++y)
      std::memcpy(&image.rgb[(kHeight - 1 - y) * 3 * kWidth], &rows[y * 3 * kWidth], 3 * kWidth);
    return image;
  }

  /// After another look at the scene nothing of it is kept.
  static Image drawn_whole(Renderer& renderer, const RenderSnapshot& snapshot,
                           const ViewState& view) {
    ViewState brighter = view;
    brighter.light_brightness += 0.5f;
    drawn(renderer, snapshot, brighter);
    return drawn(renderer, snapshot, view);
  }

  GLuint framebuffer_ = 0, texture_ = 0;
};

Case two_balls() {
  Case pair;
  for (const double x : {-0.022, 0.022}) {
    Bone bone = make_bone(x < 0 ? "left" : "right", sphere_mesh(0.02), Vec3(x, 0, 0));
    bone.pieces.push_back(cube_hull(0.014));
    pair.bones.push_back(std::move(bone));
  }
  return pair;
}

/// The tip somewhere about the balls, the shaft towards the viewer's side.
void place_tool(Random& random, RenderSnapshot& snapshot) {
  ToolState& tool = snapshot.tool;
  const double x = random.uniform(-0.05, 0.05), y = random.uniform(-0.04, 0.04);
  tool.X_WP.p = Vec3(x, y, random.uniform(0, 0.04));
  const Vec3 tilt = random.direction();
  tool.X_WP.q = turn_between(Vec3::UnitZ(), Vec3(Vec3::UnitZ() + 0.8 * tilt));
  tool.X_WD = tool.X_WP;
  tool.X_WD.p += random.uniform(0, 0.004) * random.direction();
  tool.force_W = random.uniform(0, 3) * random.direction();
  tool.contact_count = 1;
  tool.contacts[0].p_W = tool.X_WP.p;
}

ViewState any_look(Random& random) {
  ViewState view;
  view.camera.distance_m = random.uniform(0.15, 0.4);
  view.camera.orthographic = random.uniform(0, 1) < 0.3;
  view.camera.q_WC = turn_between(Vec3::UnitZ(), Vec3(Vec3::UnitZ() + 0.5 * random.direction()));
  view.light_azimuth_rad = random.uniform(-1.5, 1.5);
  view.show_hulls = random.uniform(0, 1) < 0.3;
  view.bones.resize(2);
  view.bones[0].opacity = random.uniform(0, 1) < 0.3 ? 0.4f : 1.0f;
  view.bones[1].highlighted = random.uniform(0, 1) < 0.3;
  return view;
}

TEST_F(DrawChanges, TheResultIsThatOfDrawingAll) {
  const Case balls = two_balls();
  const Tool probe = make_wrist_probe();
  Renderer renderer = make_renderer(balls, probe), other = make_renderer(balls, probe);
  Random random(41);
  for (int look = 0; look < 16; ++look) {
    ViewState view = any_look(random);
    // The last ones are so close that the shaft and its shadow run past the eye.
    if (look >= 12) view.camera.distance_m = random.uniform(0.05, 0.1);
    RenderSnapshot snapshot = at_rest(balls);
    for (int step = 0; step < 5; ++step) {
      place_tool(random, snapshot);
      // From the second step on something is shown beside it, seen through, that moves as well.
      const GhostTool ghost{Pose{-snapshot.tool.X_WP.p, snapshot.tool.X_WP.q}, 0, 0.5f};
      for (Renderer* each : {&renderer, &other}) each->set_ghosts({&ghost, step > 0 ? 1u : 0u});
      // And a mark that moves, in the last ones.
      SolidMark mark{sphere_mesh(0.008), {1.0f, 0.85f, 0.2f, 0.3f}};
      for (Vec3& p : mark.mesh_W.vertices) p += Vec3(0, 0.01 * step - 0.02, 0.02);
      for (Renderer* each : {&renderer, &other})
        each->set_moving_marks({&mark, step > 2 ? 1u : 0u});
      const Image kept = drawn(renderer, snapshot, view);
      const Image whole = drawn_whole(other, snapshot, view);
      EXPECT_LE(count_different(kept, whole, 24), 3) << "look " << look << ", step " << step;
    }
  }
}

TEST_F(DrawChanges, WhatChangesIsSeenAtOnce) {
  const Case balls = two_balls();
  Renderer renderer = make_renderer(balls, make_wrist_probe());
  Random random(42);
  ViewState view = front_view();
  RenderSnapshot snapshot = at_rest(balls);
  place_tool(random, snapshot);
  for (int k = 0; k < 3; ++k) drawn(renderer, snapshot, view);
  const Image before = drawn(renderer, snapshot, view);

  const auto change_and_back = [&](auto change) {
    const ViewState old_view = view;
    const RenderSnapshot old_snapshot = snapshot;
    change();
    EXPECT_GT(count_different(before, drawn(renderer, snapshot, view), 24), 50);
    view = old_view;
    snapshot = old_snapshot;
    for (int k = 0; k < 3; ++k)
      EXPECT_EQ(count_different(before, drawn(renderer, snapshot, view), 24), 0);
  };
  change_and_back([&] { snapshot.tool.X_WP.p.x() += 0.02; });
  change_and_back([&] { snapshot.bones.bones[0].X_WB.p.y() += 0.004; });
  change_and_back([&] { view.camera.distance_m *= 0.9; });
  change_and_back([&] { view.show_proxy = view.show_hand_ghost = false; });
  change_and_back([&] { view.light_brightness = 0.5f; });
  change_and_back([&] {
    view.bones.resize(1);
    view.bones[0].visible = false;
  });
}

TEST_F(DrawChanges, ABoneThatDriftsSlowlyIsFollowed) {
  const Case balls = two_balls();
  Renderer renderer = make_renderer(balls);
  const ViewState view = front_view();
  RenderSnapshot snapshot = at_rest(balls);
  for (int k = 0; k < 400; ++k) {
    snapshot.bones.bones[0].X_WB.p.y() += 1e-5;
    renderer.draw(snapshot, view, {0, 0, kWidth, kHeight});
  }
  const Image kept = drawn(renderer, snapshot, view);
  EXPECT_LE(count_different(kept, drawn_whole(renderer, snapshot, view), 60), 20);
}

// The picture that was kept shows the surfaces that it was drawn with.
TEST_F(DrawChanges, NewSurfacesAreShownThoughNothingMoved) {
  const Case pair = two_balls();
  PreparedCase prepared = prepare_case(pair);
  Renderer renderer = make_renderer(pair);
  const RenderSnapshot snapshot = at_rest(pair);
  ViewState view = front_view();
  view.show_felt = true;
  const Image before = drawn(renderer, snapshot, view);
  prepare_felt(pair, prepared);
  renderer.set_surfaces(prepared);
  EXPECT_NE(drawn(renderer, snapshot, view).rgb, before.rgb);
}

/// Two balls, and a soft one before them that is pressed and cut.
Case balls_and_soft() {
  Case the_case = two_balls();
  SoftPart part;
  part.name = "soft";
  part.kind = "meniscus";
  part.mesh_W = sphere_mesh(0.006);
  part.bones = {BoneId{0}, BoneId{1}};
  for (Vec3& p : part.mesh_W.vertices) p += Vec3(0.004, 0.002, 0.024);
  the_case.softs.push_back(part);
  return the_case;
}

/// A soft surface that is pressed in at one of its vertices.
TriMesh pressed_at(const TriMesh& rest, std::size_t vertex, const Vec3& by) {
  TriMesh out = rest;
  const Vec3 at = rest.vertices[vertex];
  for (Vec3& p : out.vertices) p += std::exp(-(p - at).norm() / 0.002) * by;
  return out;
}

/// Pressed here and there, later cut as well.
TriMesh given_way(const TriMesh& rest, Random& random, int step) {
  const auto count = static_cast<double>(rest.vertices.size());
  const auto vertex = static_cast<std::size_t>(random.uniform(0, 0.999 * count));
  TriMesh out = pressed_at(rest, vertex, 0.002 * random.direction());
  if (step > 6) out.triangles.resize(out.triangles.size() * 9 / 10);
  return out;
}

TEST_F(DrawChanges, SurfacesThatGiveWayAreDrawnOverWhatWasKept) {
  const Case the_case = balls_and_soft();
  const TriMesh& rest = the_case.softs[0].mesh_W;
  const Tool probe = make_wrist_probe();
  Renderer renderer = make_renderer(the_case, probe), other = make_renderer(the_case, probe);
  if (!renderer.software_driver()) GTEST_SKIP() << "only where a processor draws";
  Random random(43);
  for (int look = 0; look < 4; ++look) {
    ViewState view = any_look(random);
    view.softs.resize(1);
    view.softs[0].opacity = look % 2 ? 0.6f : 1.0f;
    RenderSnapshot snapshot = at_rest(the_case);
    int drawn_over = 0;
    for (int step = 0; step < 18; ++step) {
      place_tool(random, snapshot);
      if (step < 10) {
        const TriMesh moved = given_way(rest, random, step);
        for (Renderer* each : {&renderer, &other}) each->move_surface(BoneId{2}, rest, moved, {});
      }
      const Image kept = drawn(renderer, snapshot, view);
      drawn_over += !renderer.drew_all();
      const Image whole = drawn_whole(other, snapshot, view);
      EXPECT_LE(count_different(kept, whole, 24), 3) << "look " << look << ", step " << step;
    }
    EXPECT_GE(drawn_over, 14) << "look " << look;
  }
}

// Without a tool all rests: the picture is kept anew, and nothing is drawn over it any more.
TEST_F(DrawChanges, ASurfaceThatChangedOnceIsKept) {
  const Case the_case = balls_and_soft();
  const TriMesh& rest = the_case.softs[0].mesh_W;
  Renderer renderer = make_renderer(the_case, make_wrist_probe());
  ViewState view = front_view();
  view.softs.resize(1);
  view.show_proxy = view.show_force = view.show_hand_ghost = false;
  const RenderSnapshot snapshot = at_rest(the_case);
  for (int k = 0; k < 3; ++k) drawn(renderer, snapshot, view);
  const Image before = drawn(renderer, snapshot, view);
  const auto nearest = std::max_element(rest.vertices.begin(), rest.vertices.end(),
                                        [](const Vec3& a, const Vec3& b) { return a.z() < b.z(); });
  const TriMesh moved = pressed_at(rest, static_cast<std::size_t>(nearest - rest.vertices.begin()),
                                   Vec3(0.002, 0, -0.002));
  renderer.move_surface(BoneId{2}, rest, moved, {});
  const Image changed = drawn(renderer, snapshot, view);
  EXPECT_GT(count_different(before, changed, 24), 20);
  for (int k = 0; k < 20; ++k) EXPECT_EQ(drawn(renderer, snapshot, view).rgb, changed.rgb) << k;
  renderer.move_surface(BoneId{2}, rest, rest, {});
  EXPECT_GT(count_different(changed, drawn(renderer, snapshot, view), 24), 20);
}

// Bone is taken away cube by cube: a smaller ball stands in those that were reached.
TEST_F(DrawChanges, CubesThatAreCarvedAreDrawnOverWhatWasKept) {
  const Case balls = two_balls();
  const Tool probe = make_wrist_probe();
  Renderer renderer = make_renderer(balls, probe), other = make_renderer(balls, probe);
  if (!renderer.software_driver()) GTEST_SKIP() << "only where a processor draws";
  const CubeGrid grid{Vec3::Constant(-0.021), 0.014, {3, 3, 3}, 0.0005};
  const SurfaceCube smaller = cube_with_ball(0.017, 0.003f);
  const auto carved = [&](std::uint32_t number) {
    SurfaceCube cube = smaller;
    cube.cube = number;
    const Vec3 lo = grid.lo_B + grid.side_m * Vec3(number % 3, number / 3 % 3, number / 9);
    cube.triangles.clear();
    for (const Triangle& t : smaller.triangles) {
      const Vec3 at =
          (smaller.vertices[t[0]] + smaller.vertices[t[1]] + smaller.vertices[t[2]]) / 3;
      const Vec3 u = (at - lo) / grid.side_m;
      if ((u.array() >= 0.1).all() && (u.array() < 0.9).all()) cube.triangles.push_back(t);
    }
    return cube;
  };
  Random random(45);
  const ViewState view = any_look(random);
  RenderSnapshot snapshot = at_rest(balls);
  int drawn_over = 0;
  for (std::uint32_t number = 0; number < 27; number += 4) {
    place_tool(random, snapshot);
    const SurfaceCube cube = carved(number);
    for (Renderer* each : {&renderer, &other}) each->set_cubes(BoneId{1}, grid, {&cube, 1});
    const Image kept = drawn(renderer, snapshot, view);
    drawn_over += !renderer.drew_all();
    EXPECT_LE(count_different(kept, drawn_whole(other, snapshot, view), 24), 3) << number;
  }
  EXPECT_GE(drawn_over, 4);
}

// While all moves the picture is coarse: near the whole one, but not the same. At rest it gets
// sharp and is then the same, pixel by pixel.
TEST_F(DrawChanges, CoarseWhileAllMovesAndSharpAtRest) {
  const Case pair = two_balls();
  Renderer renderer = make_renderer(pair, make_wrist_probe());
  if (!renderer.software_driver()) GTEST_SKIP() << "only where a processor draws";
  const RenderSnapshot snapshot = at_rest(pair);
  const ViewState view = front_view();
  const Image whole = drawn_whole(renderer, snapshot, view);
  renderer.set_moving_detail(0.5);
  const Image coarse = drawn_whole(renderer, snapshot, view);
  EXPECT_TRUE(renderer.drew_all());
  double apart = 0;
  for (std::size_t k = 0; k < whole.rgb.size(); ++k)
    apart += std::abs(static_cast<double>(whole.rgb[k]) - coarse.rgb[k]);
  apart /= static_cast<double>(whole.rgb.size());
  EXPECT_GT(apart, 0);
  EXPECT_LT(apart, 6);  // of 255
  Image last = coarse;
  for (int k = 0; k < 8; ++k) last = drawn(renderer, snapshot, view);
  EXPECT_FALSE(renderer.drew_all());
  EXPECT_EQ(last.rgb, whole.rgb);
}

// A film's pictures: as they are drawn on a screen, wider than what a still is drawn in at once;
// what is bound stays bound.
TEST_F(DrawChanges, PicturesInARowAreThoseOfTheScreen) {
  const Case pair = two_balls();
  Renderer renderer = make_renderer(pair, make_wrist_probe());
  Renderer other = make_renderer(pair, make_wrist_probe());
  const ViewState view = front_view();
  RenderSnapshot snapshot = at_rest(pair);
  Random random(43);
  Image last;
  for (int step = 0; step < 4; ++step) {
    place_tool(random, snapshot);
    const Image next = other.draw_next_image(snapshot, view, kWidth, kHeight);
    GLint bound = 0;
    glGetIntegerv(GL_FRAMEBUFFER_BINDING, &bound);
    EXPECT_EQ(bound, static_cast<GLint>(framebuffer_));
    EXPECT_EQ(next.rgb, drawn(renderer, snapshot, view).rgb) << step;
    EXPECT_NE(next.rgb, last.rgb);
    last = next;
  }
  EXPECT_EQ(other.drew_all(), !renderer.software_driver()) << "nothing was kept";
  const Image wide = other.draw_next_image(snapshot, view, 1100, 60);
  EXPECT_EQ(wide.width, 1100);
  EXPECT_LE(count_different(wide, renderer.draw_image(snapshot, view, 1100, 60), 24), 200);
}

TEST_F(DrawChanges, NoDetailIsTakenForWhole) {
  const Case pair = two_balls();
  Renderer renderer = make_renderer(pair, make_wrist_probe());
  const RenderSnapshot snapshot = at_rest(pair);
  const ViewState view = front_view();
  const Image whole = drawn_whole(renderer, snapshot, view);
  for (const double share : {std::nan(""), 1.0, 7.0}) {
    renderer.set_moving_detail(share);
    EXPECT_EQ(drawn_whole(renderer, snapshot, view).rgb, whole.rgb) << share;
  }
}

}  // namespace
}  // namespace osteon
