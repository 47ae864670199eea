// Skin that bends with a knee, as the graphics card moves it, against the same skin moved before it
// was given to be drawn.
#include <numbers>

#include "gl_fixture.h"
#include "osteon/scene/limb_cover.h"

namespace osteon {
namespace {

Case limb_at(const Pose& tibia_moved) {
  Case limb;
  for (const double side : {1.0, -1.0}) {
    TriMesh ball = sphere_mesh(0.006);
    // Aslant: the limb is bent forwards at rest.
    const Quat aslant(Eigen::AngleAxisd(-side * 0.4, Vec3::UnitZ()));
    for (Vec3& p : ball.vertices)
      p = aslant * Vec3(p.x(), 5 * p.y(), p.z()) + Vec3(0, side * 0.040, 0);
    limb.bones.push_back(make_bone(side > 0 ? "femur" : "tibia", ball, Vec3::Zero()));
  }
  limb.bones[1].X_WB = tibia_moved;
  limb.landmarks.push_back({"portal_al", Vec3(0.004, -0.008, 0.012), Vec3::Zero(), "tibia"});
  SoftPart skin;
  skin.name = skin.kind = "skin";
  skin.mesh_W = ball(60, 60);
  for (Vec3& p : skin.mesh_W.vertices) p = 0.015 * Vec3(p.x(), 4.5 * p.y(), p.z());
  limb.softs.push_back(skin);
  return limb;
}

constexpr int kOther = 70;  // of 765: skin or none

class CoverPicture : public GlTest {
 protected:
  static Image picture(Renderer& renderer, const RenderSnapshot& snapshot, float opacity) {
    ViewState view = front_view();
    view.show_proxy = false;
    view.ambient_occlusion = 0;
    view.softs.resize(1);
    view.softs[0].opacity = opacity;
    return renderer.draw_image(snapshot, view, 300, 300);
  }
};

TEST_F(CoverPicture, IsThatOfSkinMovedBeforehand) {
  const Case limb = limb_at({});
  const Pose turned{Vec3(0.002, 0.001, 0), Quat(Eigen::AngleAxisd(0.6, Vec3::UnitZ()))};
  RenderSnapshot bent = at_rest(limb);
  bent.bones.bones[1].X_WB = turned;

  Case moved = limb_at(turned);
  const auto cover = LimbCover::over(limb);
  ASSERT_TRUE(cover);
  std::vector<Pose> rest(2);
  const CoverMotion motion = cover->motion(bent.bones, rest);
  for (Vec3& p : moved.softs[0].mesh_W.vertices) p = motion.moved(p, cover->share(p));

  Renderer bending = make_renderer(limb), rigid = make_renderer(moved);
  for (const float opacity : {1.0f, 0.4f}) {
    const Image as_drawn = picture(bending, bent, opacity);
    const Image wanted = picture(rigid, at_rest(moved), opacity);
    // The skin's grain stays with it, so light differs a little; the outline by a pixel of few.
    EXPECT_LT(count_different(as_drawn, wanted, kOther), 250) << opacity;
    const Image straight = picture(bending, at_rest(limb), opacity);
    EXPECT_GT(count_different(straight, wanted, kOther), 8000) << opacity;
  }
}

// The bones in it are seen then, as through skin that was made clear.
TEST_F(CoverPicture, SkinThatIsBentFarIsSeenThrough) {
  const Case limb = limb_at({});
  Renderer renderer = make_renderer(limb);
  RenderSnapshot bent = at_rest(limb);
  for (const double turn : {0.9, 1.2}) {
    bent.bones.bones[1].X_WB.q = Quat(Eigen::AngleAxisd(turn, Vec3::UnitZ()));
    const Image solid = picture(renderer, bent, 1), clear = picture(renderer, bent, 0.28f);
    const int differs = count_different(solid, clear, kOther);
    EXPECT_EQ(differs > 3000, turn < 1) << turn << " " << differs;
    EXPECT_EQ(differs == 0, turn > 1) << turn << " " << differs;
  }
}

// Skin does not follow a kneecap that glides on the femur: it would stand out of what covers it.
TEST_F(CoverPicture, TheKneecapIsDrawnUnlessBentSkinIsSolid) {
  const Case without = limb_at({});
  Case with = limb_at({});
  with.bones.push_back(make_bone("patella", sphere_mesh(0.025), Vec3::Zero()));
  Renderer bare = make_renderer(without), renderer = make_renderer(with);
  const auto differs = [&](double turn, float opacity) {
    RenderSnapshot a = at_rest(without), b = at_rest(with);
    for (RenderSnapshot* bent : {&a, &b})
      bent->bones.bones[1].X_WB.q = Quat(Eigen::AngleAxisd(turn, Vec3::UnitZ()));
    return count_different(picture(bare, a, opacity), picture(renderer, b, opacity), kOther);
  };
  EXPECT_GT(differs(0, 1), 1000);
  EXPECT_LT(differs(0.6, 1), 60) << "pixels of the outline: the picture's depth is another";
  EXPECT_GT(differs(0.6, 0.4f), 1000);
}

}  // namespace
}  // namespace osteon
