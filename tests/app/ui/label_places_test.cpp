#include "ui/label_places.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace osteon {
namespace {

bool covers(const UiRect& a, const UiRect& b) {
  return a.x < b.right() && b.x < a.right() && a.y < b.bottom() && b.y < a.bottom();
}

TEST(LabelPlaces, NoneGivesNone) { EXPECT_TRUE(spread_labels({}, 2).empty()); }

TEST(LabelPlaces, WhatIsFreeStaysWhereItIsWanted) {
  const std::vector<UiRect> wanted{{0, 0, 50, 12}, {0, 20, 50, 12}, {80, 0, 50, 12}};
  const std::vector<UiRect> placed = spread_labels(wanted, 2);
  ASSERT_EQ(placed.size(), wanted.size());
  for (std::size_t i = 0; i < wanted.size(); ++i) EXPECT_EQ(placed[i].y, wanted[i].y) << i;
}

TEST(LabelPlaces, TheSecondOfTwoMovesToTheNearerSide) {
  const std::vector<UiRect> wanted{{0, 100, 50, 12}, {30, 96, 50, 12}};
  const std::vector<UiRect> placed = spread_labels(wanted, 2);
  EXPECT_EQ(placed[0].y, 100);
  EXPECT_NEAR(placed[1].y, 100 - 2 - 12, 0.1);
  EXPECT_EQ(placed[1].x, 30) << "labels move up and down alone";
}

TEST(LabelPlaces, TheyKeepOffWhatIsTaken) {
  const std::vector<UiRect> placed =
      spread_labels(std::vector<UiRect>{{0, 100, 50, 12}}, 2, {{10, 90, 20, 20}});
  ASSERT_EQ(placed.size(), 1u);
  EXPECT_FALSE(covers(placed[0], {10, 90, 20, 20}));
}

TEST(LabelPlaces, OfACrowdNoneCoversAnother) {
  std::mt19937 random(7);
  std::uniform_real_distribution<float> at(0, 120), width(20, 60);
  for (int round = 0; round < 50; ++round) {
    std::vector<UiRect> wanted;
    for (int i = 0; i < 12; ++i) wanted.push_back({at(random), at(random), width(random), 11.7f});
    const std::vector<UiRect> placed = spread_labels(wanted, 2.3f);
    ASSERT_EQ(placed.size(), wanted.size());
    for (std::size_t i = 0; i < placed.size(); ++i) {
      EXPECT_LE(std::abs(placed[i].y - wanted[i].y), 120);
      for (std::size_t k = 0; k < i; ++k) EXPECT_FALSE(covers(placed[i], placed[k])) << i << k;
    }
  }
}

TEST(LabelPlaces, WhatFindsNoRoomNearStays) {
  const std::vector<UiRect> wanted(40, UiRect{0, 200, 50, 10});
  const std::vector<UiRect> placed = spread_labels(wanted, 2);
  for (const UiRect& r : placed) EXPECT_LE(std::abs(r.y - 200), 100);
}

}  // namespace
}  // namespace osteon
