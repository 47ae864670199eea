// The window's picture of what gives way: it follows the pushes, and goes back to rest.
#include "window/controllers/views/soft_picture.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "osteon/render/renderer.h"
#include "session/soft_solid_fixtures.h"

namespace osteon {
namespace {

class SoftPictures : public ::testing::Test {
 protected:
  void SetUp() override {
    auto made = OffscreenContext::create();
    if (!made) GTEST_SKIP() << "no OpenGL without a window here: " << made.error().message();
    context.emplace(std::move(*made));
    auto drawn = Renderer::create(the_case(), Tool{}, OSTEON_SOURCE_DIR);
    ASSERT_TRUE(drawn) << drawn.error().message();
    renderer.emplace(std::move(*drawn));
  }
  void TearDown() override {
    renderer.reset();
    context.reset();
  }

  static const Case& the_case() { return *testing::meniscus_run().the_case; }
  static SoftPushes pressed(double force_n) {
    SoftPushes pushes;
    if (force_n > 0) pushes.count = 1;
    pushes.all[0].p_B = {0, 0, 0.040 + testing::kMeniscusHalf.z()};
    pushes.all[0].force_n = force_n;
    return pushes;
  }
  void show(double force_n, double now_s, bool with_setup = true) {
    const testing::MeniscusRun& run = testing::meniscus_run();
    picture.show(run.the_case, with_setup ? run.softs : nullptr, pressed(force_n), now_s,
                 *renderer);
  }
  // From the side: what goes down leaves the upper edge of the block.
  std::vector<std::uint8_t> look() {
    ViewState view = default_view(the_case());
    for (BoneAppearance& bone : view.bones) bone.visible = false;
    for (BoneAppearance& soft : view.softs) soft = BoneAppearance{};
    view.camera.target_W = {0, 0, 0};
    view.camera.distance_m = 0.08;
    view.camera.q_WC = Quat(std::sqrt(0.5), std::sqrt(0.5), 0, 0);
    view.show_proxy = false;
    RenderSnapshot snapshot;
    snapshot.bones = rest_snapshot(the_case());
    return renderer->draw_image(snapshot, view, 240, 160).rgb;
  }

  std::optional<OffscreenContext> context;
  std::optional<Renderer> renderer;
  SoftPicture picture;
};

TEST_F(SoftPictures, FollowsThePushAndGoesBack) {
  const auto rest = look();
  ASSERT_NE(*std::max_element(rest.begin(), rest.end()),
            *std::min_element(rest.begin(), rest.end()));
  show(0, 0);
  EXPECT_EQ(look(), rest);
  show(3, 1);
  const auto pushed = look();
  EXPECT_NE(pushed, rest);
  show(0, 2);
  EXPECT_EQ(look(), rest) << "the light and the shape are those of before";
}

// A processor that draws gets another shape a tenth of a second later at the soonest.
TEST_F(SoftPictures, AProcessorIsNotAskedTooOften) {
  const auto rest = look();
  show(3, 1);
  const auto pushed = look();
  show(0, 1.05);
  EXPECT_EQ(look(), renderer->software_driver() ? pushed : rest);
  show(0, 1.11);
  EXPECT_EQ(look(), rest);
}

TEST_F(SoftPictures, WithoutItsSetupEverythingIsAtRest) {
  const auto rest = look();
  show(3, 1);
  show(3, 2, false);
  EXPECT_EQ(look(), rest);
  show(3, 3);
  EXPECT_NE(look(), rest);
}

// The renderer was given its surfaces anew: the push is drawn again, though it is the same one.
TEST_F(SoftPictures, BeginsAgainAfterTheSurfacesWereGivenAnew) {
  const auto rest = look();
  show(3, 1);
  const auto pushed = look();
  renderer->set_surfaces(prepare_case(the_case()));
  EXPECT_EQ(look(), rest);
  picture.begin_again();
  show(3, 2);
  EXPECT_EQ(look(), pushed);
}

}  // namespace
}  // namespace osteon
