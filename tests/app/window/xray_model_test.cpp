#include "window/xray_model.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace osteon {
namespace {

TEST(XrayPlaces, PictureAndDeskLieInThePaneSideBySideWithoutCoveringEachOther) {
  for (const float scale : {1.0f, 1.5f, 3.0f})
    for (const float w : {2.0f, 60.0f, 420.0f, 700.0f, 1400.0f})
      for (const float h : {2.0f, 60.0f, 420.0f, 700.0f}) {
        const UiRect pane{10, 20, w, h};
        const XrayPlaces at = xray_places(pane, scale);
        for (const UiRect& r : {at.picture, at.desk}) {
          EXPECT_GE(r.x, pane.x);
          EXPECT_GE(r.y, pane.y);
          EXPECT_LE(r.right(), pane.right());
          EXPECT_LE(r.bottom(), pane.bottom());
          EXPECT_GT(r.w, 0);
          EXPECT_GT(r.h, 0);
        }
        if (std::min(w, h) <= 60) continue;
        EXPECT_TRUE(at.beside ? at.picture.right() < at.desk.x : at.picture.bottom() < at.desk.y);
      }
}

TEST(XrayPlaces, TheDeskStandsWhereItLeavesThePictureLarger) {
  const XrayPlaces wide = xray_places({0, 0, 900, 600}, 1);
  EXPECT_TRUE(wide.beside);
  EXPECT_EQ(std::min(wide.picture.w, wide.picture.h), 600);
  const XrayPlaces tall = xray_places({0, 0, 500, 900}, 1);
  EXPECT_FALSE(tall.beside);
  EXPECT_EQ(std::min(tall.picture.w, tall.picture.h), 500);
}

}  // namespace
}  // namespace osteon
