#include "window/views_model.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

namespace osteon {
namespace {

constexpr PictureLayout kAllLayouts[] = {PictureLayout::kOutside, PictureLayout::kScope,
                                         PictureLayout::kPanorama, PictureLayout::kAll,
                                         PictureLayout::kFluoro};

bool apart(const UiRect& a, const UiRect& b) {
  return a.right() <= b.x || b.right() <= a.x || a.bottom() <= b.y || b.bottom() <= a.y;
}

TEST(ViewsModel, NamesAreThoseOfTheCommandLine) {
  EXPECT_EQ(*parse_picture_layout("layout"), PictureLayout::kAll);
  EXPECT_EQ(*parse_picture_layout("scope"), PictureLayout::kScope);
  const auto wrong = parse_picture_layout("Scope");
  ASSERT_FALSE(wrong);
  EXPECT_NE(wrong.error().message().find("panorama"), std::string::npos);
}

TEST(ViewsModel, NextGoesThroughAllAndComesBack) {
  PictureLayout now = PictureLayout::kOutside;
  std::set<PictureLayout> seen;
  for (std::size_t k = 0; k < kPictureLayouts; ++k) {
    seen.insert(now);
    now = next_layout(now);
  }
  EXPECT_EQ(seen.size(), kPictureLayouts);
  EXPECT_EQ(now, PictureLayout::kOutside);
}

TEST(ViewsModel, PanesLieApartWithinTheirSpaceAndTheFirstHasTheLargestCircle) {
  for (const UiRect free : {UiRect{168, 48, 896, 610}, UiRect{10, 20, 420, 500},
                            UiRect{0, 0, 1920, 400}, UiRect{0, 0, 60, 60}, UiRect{0, 0, 1, 1}})
    for (const PictureLayout layout : kAllLayouts)
      for (const bool shot : {false, true}) {
        const std::vector<Pane> panes = panes_of(layout, free, 1, shot);
        ASSERT_EQ(panes.size(), layout != PictureLayout::kAll ? 1u : shot ? 4u : 3u);
        for (std::size_t i = 0; i < panes.size(); ++i) {
          if (free.w < 100) continue;  // no room for several: nothing but no crash is asked
          const UiRect& r = panes[i].area;
          EXPECT_GE(r.x, free.x);
          EXPECT_GE(r.y, free.y);
          EXPECT_LE(r.right(), free.right() + 0.5f);
          EXPECT_LE(r.bottom(), free.bottom() + 0.5f);
          EXPECT_EQ(panes[i].large, i == 0);
          for (std::size_t j = 0; j < i; ++j) {
            EXPECT_TRUE(apart(r, panes[j].area));
            EXPECT_LE(std::min(r.w, r.h), std::min(panes[0].area.w, panes[0].area.h));
          }
        }
      }
}

}  // namespace
}  // namespace osteon
