// Jaws are drawn as far open as the hand holds them, from outside and through a scope.
#include <cmath>
#include <limits>

#include "gl_fixture.h"
#include "osteon/base/turn.h"
#include "osteon/render/scope_renderer.h"
#include "osteon/scene/instrument.h"

namespace osteon {
namespace {

class OpenJaws : public GlTest {
 protected:
  static const Instrument& grasper() {
    static const std::vector<Instrument> all = *load_instruments();
    return *find_instrument(all, "grasper");
  }
  static Case jaws_ball(const Vec3& at = Vec3::Zero()) {
    Case the_case;
    the_case.bones.push_back(make_bone("ball", sphere_mesh(0.005), at));
    return the_case;
  }
  // Across the picture, before the bone, its jaws opening in it.
  static RenderSnapshot holding(const Case& the_case, double jaw) {
    RenderSnapshot snapshot = at_rest(the_case);
    snapshot.tool.tick = 1;
    snapshot.tool.jaw = jaw;
    snapshot.tool.X_WP = {Vec3(-0.006, -0.006, 0.010), turn_between(Vec3::UnitZ(), Vec3::UnitX())};
    snapshot.tool.X_WD = snapshot.tool.X_WP;
    return snapshot;
  }
  static std::size_t changed(const Image& a, const Image& b) {
    std::size_t count = 0;
    for (std::size_t k = 0; k < a.rgb.size(); ++k)
      count += std::abs(static_cast<int>(a.rgb[k]) - static_cast<int>(b.rgb[k])) > 8 ? 1 : 0;
    return count;
  }
};

TEST(JawStep, IsTheNearestAndNeverOutside) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const double shut : {nan, -1.0, 0.0, 0.06}) EXPECT_EQ(jaw_step(shut), 0u) << shut;
  EXPECT_EQ(jaw_step(0.07), 1u);
  EXPECT_EQ(jaw_step(0.5), kJawSteps / 2);
  for (const double wide : {0.95, 1.0, 7.0}) EXPECT_EQ(jaw_step(wide), kJawSteps) << wide;
}

TEST_F(OpenJaws, AreDrawnAsOpenAsTheyAre) {
  const Case ball = jaws_ball();
  const auto tool = std::make_shared<const Tool>(make_tool(grasper(), grasper().usual_size));
  ASSERT_EQ(tool->opened.size(), kJawSteps);
  Renderer renderer = make_renderer(ball, *tool);
  ViewState near = front_view();
  near.camera.distance_m = 0.06;
  const auto picture = [&](double jaw) {
    return renderer.draw_image(holding(ball, jaw), near, 320, 240);
  };
  const Image shut = picture(0);
  EXPECT_EQ(picture(0.02).rgb, shut.rgb);
  const Image half = picture(0.5), wide = picture(1);
  EXPECT_GT(changed(half, shut), 50u);
  EXPECT_GT(changed(wide, half), 50u);
  EXPECT_EQ(picture(0).rgb, shut.rgb);
  // As if a tool that is open were drawn shut.
  Tool open = make_tool(grasper(), grasper().usual_size, 1);
  open.opened.clear();
  Renderer other = make_renderer(ball, open);
  EXPECT_EQ(other.draw_image(holding(ball, 0), near, 320, 240).rgb, wide.rgb);
  // What has no jaws looks the same however they stand.
  EXPECT_EQ(other.draw_image(holding(ball, 1), near, 320, 240).rgb, wide.rgb);
}

TEST_F(OpenJaws, AreSeenOpenThroughAScope) {
  const Case ball = jaws_ball({0.1, 0, 0});  // aside: the scope stands at the origin
  auto scope = ScopeRenderer::create(ball, OSTEON_SOURCE_DIR, prepare_case(ball));
  ASSERT_TRUE(scope) << scope.error().message();
  const std::vector<std::shared_ptr<const Tool>> tray = {
      std::make_shared<const Tool>(make_tool(grasper(), grasper().usual_size))};
  scope->set_tray(tray);
  ScopeDef def;
  def.angle_rad = 0;
  def.field_rad = 1.83;
  def.barrel = 0.6;
  const ScopeCamera camera(def, {});
  const auto picture = [&](double jaw) {
    RenderSnapshot snapshot = holding(ball, jaw);
    snapshot.tool.X_WP =
        camera.X_WC() * Pose{Vec3(-0.006, 0, -0.02), turn_between(Vec3::UnitZ(), Vec3::UnitX())};
    scope->set_scene(snapshot.bones, {&snapshot.tool, 1});
    return scope->draw_image(camera, 160, 160, RenderQuality::kFast);
  };
  const Image shut = picture(0);
  scope->set_scene(holding(ball, 0).bones, {});
  const Image none = scope->draw_image(camera, 160, 160, RenderQuality::kFast);
  EXPECT_GT(changed(none, shut), 200u) << "the tool is in sight";
  EXPECT_GT(changed(picture(1), shut), 50u);
  EXPECT_EQ(changed(picture(0.02), shut), 0u);
}

}  // namespace
}  // namespace osteon
