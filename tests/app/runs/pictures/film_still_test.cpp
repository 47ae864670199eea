#include "runs/pictures/film_still.h"

#include <gtest/gtest.h>

#include <memory>
#include <string>

#include "film_ball.h"
#include "osteon/render/renderer.h"

namespace osteon {
namespace {

class FilmStillTest : public ::testing::Test {
 protected:
  void SetUp() override {
    if (auto context = OffscreenContext::create(); !context)
      GTEST_SKIP() << "no OpenGL without a window here: " << context.error().message();
  }
  Result<FilmPainter> painter() const {
    return FilmPainter::create(case_, {}, {}, false, {FilmView::kOutside, 96, 64});
  }
  std::shared_ptr<const Case> case_ = testing::a_ball();
};

TEST_F(FilmStillTest, WithoutTicksItSaysSo) {
  auto paints = painter();
  ASSERT_TRUE(paints) << paints.error().message();
  FilmStill still(std::move(*paints), FilmSofts(*case_, nullptr), 1);
  const auto image = still.finish();
  ASSERT_FALSE(image);
  EXPECT_NE(image.error().message().find("no ticks"), std::string::npos);
}

// Of the last tick, whatever was drawn before.
TEST_F(FilmStillTest, IsThePictureOfTheLastMoment) {
  auto paints = painter();
  ASSERT_TRUE(paints) << paints.error().message();
  FilmStill still(std::move(*paints), FilmSofts(*case_, nullptr), 1);
  for (std::uint64_t tick = 1; tick <= 400; ++tick)
    still.see(0, testing::tool_across_ball(tick), rest_snapshot(*case_));
  const auto image = still.finish();
  ASSERT_TRUE(image) << image.error().message();
  const auto drawn_at = [&](std::uint64_t tick) {
    auto alone = painter();
    EXPECT_TRUE(alone);
    FilmMoment moment;
    moment.bones = rest_snapshot(*case_);
    moment.tools[0] = testing::tool_across_ball(tick);
    moment.time_s = moment.tools[0].time_s;
    return alone->draw(moment)->rgb;
  };
  EXPECT_EQ(image->rgb, drawn_at(400));
  EXPECT_NE(image->rgb, drawn_at(1));
}

}  // namespace
}  // namespace osteon
