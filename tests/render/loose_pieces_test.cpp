// Pieces of bone that were cut off are drawn where a snapshot has them.
#include <cmath>
#include <limits>

#include "gl_fixture.h"

namespace osteon {
namespace {

constexpr std::uint64_t kPieceShape = 77;

class LoosePiecesPicture : public GlTest {
 protected:
  static SurfaceCube ball_surface(double radius_m) {
    SurfaceCube out;
    const TriMesh mesh = sphere_mesh(radius_m);
    out.vertices = mesh.vertices;
    out.triangles = mesh.triangles;
    for (const Vec3& v : mesh.vertices) out.normals.push_back(v.normalized());
    out.depth_m.assign(mesh.vertices.size(), 0);
    return out;
  }
  static Case hidden_ball() {
    Case the_case;
    the_case.bones.push_back(make_bone("ball", sphere_mesh(0.02), Vec3(0.5, 0, 0)));
    return the_case;
  }
  static RenderSnapshot with_piece(const Case& the_case, const Vec3& at) {
    RenderSnapshot snapshot = at_rest(the_case);
    snapshot.bones.loose.count = 1;
    snapshot.bones.loose.bones[0] = {kPieceShape, 0, {at, Quat::Identity()}};
    return snapshot;
  }
  static ViewState plain() {
    ViewState view = front_view();
    view.show_proxy = false;
    return view;
  }
};

// Where the picture differs from that without it: as large as the projection, and there.
TEST_F(LoosePiecesPicture, OneIsSeenWhereItIsAndAsLargeAsItIs) {
  const Case the_case = hidden_ball();
  Renderer renderer = make_renderer(the_case);
  const double radius = 0.03;
  renderer.set_loose(kPieceShape, BoneId{0}, ball_surface(radius));
  const Image none = renderer.draw_image(at_rest(the_case), plain(), 300, 200);
  const Vec3 at(0.006, 0.004, 0);
  const Image with = renderer.draw_image(with_piece(the_case, at), plain(), 300, 200);
  const double d = plain().camera.distance_m;
  const double per_m = 100 / std::tan(0.5 * plain().camera.vertical_fov_rad) / d;
  const double area = 3.14159265 * std::pow(radius * per_m, 2) / (1 - std::pow(radius / d, 2));
  EXPECT_NEAR(count_different(none, with, 40), area, 0.04 * area);
  const int x = 150 + static_cast<int>(std::lround(at.x() * per_m));
  const int y = 100 - static_cast<int>(std::lround(at.y() * per_m));
  EXPECT_GT(brightness(with, x, y), brightness(none, x, y) + 60);
}

TEST_F(LoosePiecesPicture, WhatIsNotKnownOrHiddenOrNotANumberIsNotDrawn) {
  const Case the_case = hidden_ball();
  Renderer renderer = make_renderer(the_case);
  const Image none = renderer.draw_image(at_rest(the_case), plain(), 300, 200);
  RenderSnapshot snapshot = with_piece(the_case, Vec3::Zero());
  EXPECT_EQ(renderer.draw_image(snapshot, plain(), 300, 200).rgb, none.rgb) << "no such shape";
  renderer.set_loose(kPieceShape, BoneId{0}, ball_surface(0.01));
  ViewState without_bone = plain();
  without_bone.bones.resize(1);
  without_bone.bones[0].visible = false;
  EXPECT_EQ(renderer.draw_image(snapshot, without_bone, 300, 200).rgb, none.rgb);
  snapshot.bones.loose.bones[0].X_WB.p.x() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(renderer.draw_image(snapshot, plain(), 300, 200).rgb, none.rgb);
}

// In a window only what moves is drawn anew: the same picture as one that is drawn whole.
TEST_F(LoosePiecesPicture, OneThatMovesLeavesNothingBehind) {
  const Case the_case = hidden_ball();
  Renderer renderer = make_renderer(the_case);
  renderer.set_loose(kPieceShape, BoneId{0}, ball_surface(0.01));
  GLuint framebuffer = 0, texture = 0;
  glGenFramebuffers(1, &framebuffer);
  glGenTextures(1, &texture);
  glBindTexture(GL_TEXTURE_2D, texture);
  glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, 300, 200, 0, GL_RGBA, GL_UNSIGNED_BYTE, nullptr);
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
  glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, texture, 0);
  const auto drawn = [&](const RenderSnapshot& snapshot, const ViewState& view) {
    renderer.draw(snapshot, view, {0, 0, 300, 200});
    Image image{300, 200, std::vector<std::uint8_t>(3u * 300 * 200)};
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
    glReadPixels(0, 0, 300, 200, GL_RGB, GL_UNSIGNED_BYTE, image.rgb.data());
    return image;
  };
  for (int n = 0; n < 4; ++n) drawn(with_piece(the_case, Vec3(-0.02, 0, 0)), plain());
  for (int n = 1; n <= 4; ++n) {
    const RenderSnapshot now = with_piece(the_case, Vec3(-0.02 + 0.01 * n, 0, 0));
    const Image part = drawn(now, plain());
    ViewState brighter = plain();
    brighter.light_brightness += 0.5f;
    drawn(now, brighter);
    EXPECT_LT(count_different(part, drawn(now, plain()), 6), 5) << n;
  }
  glDeleteFramebuffers(1, &framebuffer);
  glDeleteTextures(1, &texture);
}

}  // namespace
}  // namespace osteon
