// Instruments that are only shown: seen through, by their opacity, and gone once taken away.
#include <cmath>
#include <limits>

#include "gl_fixture.h"

#include "osteon/base/turn.h"

namespace osteon {
namespace {

class GhostTools : public GlTest {
 protected:
  /// Beside the bone, across the picture.
  static GhostTool beside(float opacity) {
    return {
        Pose{Vec3(0.02, -0.01, 0.03), turn_between(Vec3::UnitZ(), Vec3(1, 0, 0.2).normalized())}, 0,
        opacity};
  }
  static RenderSnapshot without_tool(const Case& the_case) {
    RenderSnapshot snapshot = at_rest(the_case);
    snapshot.tool.X_WP.p = snapshot.tool.X_WD.p = Vec3(0.5, 0.5, 0.5);  // out of sight
    return snapshot;
  }
  static Image picture(Renderer& renderer, const RenderSnapshot& snapshot) {
    return renderer.draw_image(snapshot, front_view(), 320, 240);
  }
  static double apart(const Image& a, const Image& b) {
    double sum = 0;
    for (std::size_t k = 0; k < a.rgb.size(); ++k)
      sum += std::abs(static_cast<double>(a.rgb[k]) - b.rgb[k]);
    return sum;
  }
};

Case ghost_ball() {
  Case the_case;
  the_case.bones.push_back(make_bone("ball", sphere_mesh(0.02), Vec3::Zero()));
  return the_case;
}

TEST_F(GhostTools, AreSeenByTheirOpacityAndGoAgain) {
  const Case ball = ghost_ball();
  Renderer renderer = make_renderer(ball, make_wrist_probe());
  const RenderSnapshot snapshot = without_tool(ball);
  const Image none = picture(renderer, snapshot);
  double before = 0;
  for (const float opacity : {0.2f, 0.5f, 0.8f}) {
    const GhostTool ghost = beside(opacity);
    renderer.set_ghosts({&ghost, 1});
    const double change = apart(picture(renderer, snapshot), none);
    EXPECT_GT(change, before + 1000) << opacity;
    before = change;
  }
  const GhostTool most = beside(0.8f), more = beside(1.0f);
  renderer.set_ghosts({&most, 1});
  const Image at_most = picture(renderer, snapshot);
  renderer.set_ghosts({&more, 1});
  EXPECT_EQ(picture(renderer, snapshot).rgb, at_most.rgb) << "never solid";
  renderer.set_ghosts({});
  EXPECT_EQ(picture(renderer, snapshot).rgb, none.rgb);
}

TEST_F(GhostTools, WhatCannotBeSeenIsNotDrawn) {
  const Case ball = ghost_ball();
  Renderer renderer = make_renderer(ball, make_wrist_probe());
  const RenderSnapshot snapshot = without_tool(ball);
  const Image none = picture(renderer, snapshot);
  GhostTool lost = beside(0.5f);
  lost.X_WT.p.x() = std::numeric_limits<double>::quiet_NaN();
  const std::vector<GhostTool> ghosts{lost, beside(0), beside(-1),
                                      beside(std::numeric_limits<float>::quiet_NaN())};
  renderer.set_ghosts(ghosts);
  EXPECT_EQ(picture(renderer, snapshot).rgb, none.rgb);
}

TEST_F(GhostTools, AnotherViewHasItsOwn) {
  const Case ball = ghost_ball();
  Renderer renderer = make_renderer(ball, make_wrist_probe());
  Renderer other = renderer.another_view();
  const RenderSnapshot snapshot = without_tool(ball);
  const Image none = picture(renderer, snapshot);
  const GhostTool ghost = beside(0.5f);
  other.set_ghosts({&ghost, 1});
  EXPECT_EQ(picture(renderer, snapshot).rgb, none.rgb);
  EXPECT_NE(picture(other, snapshot).rgb, none.rgb);
}

}  // namespace
}  // namespace osteon
