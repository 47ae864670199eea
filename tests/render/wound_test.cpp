// Cuts in skin are drawn in the colours of its section and of the fat below.
#include "gl_fixture.h"

namespace osteon {
namespace {

class WoundPicture : public GlTest {
 protected:
  // A ball of skin that was cut open: in place of it another one, whose surface lies so deep in a
  // cut.
  static Image opened(float depth_m) {
    Case the_case;
    the_case.bones.push_back(make_bone("far", sphere_mesh(0.01), Vec3(0.5, 0, 0)));
    SoftPart skin;
    skin.name = skin.kind = "skin";
    skin.color_srgb = {0.86f, 0.66f, 0.56f};
    skin.mesh_W = sphere_mesh(0.01);
    the_case.softs.push_back(skin);
    Renderer renderer = make_renderer(the_case);
    TriMesh cut = skin.mesh_W;
    std::vector<float> depths(cut.vertices.size(), 0.0f);
    const TriMesh wall = sphere_mesh(0.03);
    const auto first = static_cast<std::uint32_t>(cut.vertices.size());
    for (const Vec3& p : wall.vertices) {
      cut.vertices.push_back(p);
      depths.push_back(depth_m);
    }
    for (const Triangle& t : wall.triangles)
      cut.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
    renderer.move_surface(BoneId{1}, skin.mesh_W, cut, depths);
    ViewState view = front_view();
    view.show_proxy = false;
    view.softs.resize(1);
    view.softs[0].visible = true;
    view.softs[0].opacity = 1;
    view.softs[0].color = skin.color_srgb;
    return renderer.draw_image(at_rest(the_case), view, 200, 200);
  }
  static std::array<double, 3> middle_of(const Image& image) {
    const std::size_t at = 3 * (100 * std::size_t{200} + 100);
    return {double(image.rgb[at]), double(image.rgb[at + 1]), double(image.rgb[at + 2])};
  }
};

TEST_F(WoundPicture, UnderTheLipsLieTheSkinsSectionThenBloodThenYellowFat) {
  const auto outside = middle_of(opened(0)), section = middle_of(opened(0.0005f)),
             blood = middle_of(opened(0.002f)), fat = middle_of(opened(0.0035f));
  const auto share = [](const std::array<double, 3>& of, std::size_t k) { return of[k] / of[0]; };
  // Fat is the yellowest, blood the reddest; a section is pinker than skin.
  EXPECT_LT(share(fat, 2), 0.8 * share(section, 2));
  EXPECT_GT(share(fat, 1), share(section, 1) + 0.03);
  EXPECT_LT(share(blood, 1), 0.7 * share(section, 1));
  EXPECT_LT(share(section, 1), share(outside, 1));
}

}  // namespace
}  // namespace osteon
