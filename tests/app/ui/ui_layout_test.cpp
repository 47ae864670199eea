#include "ui/ui_layout.h"

#include <gtest/gtest.h>

namespace osteon {
namespace {

TEST(UiLayout, FoldedThePictureIsTheWholeWindow) {
  const UiLayout layout = make_layout(1280, 720, 1, false);
  EXPECT_EQ(layout.picture.w, 1280);
  EXPECT_EQ(layout.picture.h, 720);
  EXPECT_EQ(layout.left.w, 0);
}

TEST(UiLayout, TheLeftCardThatNobodyDraggedIsAsWideAsTheWindowAllows) {
  EXPECT_EQ(make_layout(640, 400, 1, true).left.w, 152);
  EXPECT_EQ(make_layout(800, 600, 1, true).left.w, 152);
  EXPECT_EQ(make_layout(1280, 720, 1, true).left.w, 172);
  EXPECT_EQ(make_layout(2560, 1440, 2, true).left.w, 344) << "in units the same";
  EXPECT_EQ(make_layout(3840, 2160, 1, true).left.w, 200);
}

TEST(UiLayout, ADraggedLeftCardStaysWithinItsLimits) {
  EXPECT_EQ(make_layout(1280, 720, 1, true, 10).left.w, kLeastLeftCard);
  EXPECT_EQ(make_layout(1280, 720, 1, true, 300).left.w, 300);
  EXPECT_EQ(make_layout(1280, 720, 1, true, 900).left.w, kMostLeftCard);
  EXPECT_EQ(make_layout(640, 400, 1, true, 360).left.w, 213) << "a third of the window";
}

}  // namespace
}  // namespace osteon
