#include "gl/tile_mask.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "osteon/base/random.h"

namespace osteon {
namespace {

using Eigen::Vector2d;

/// How many of the rectangles hold the pixel.
int holders(const std::vector<Viewport>& rectangles, int x, int y) {
  int count = 0;
  for (const Viewport& r : rectangles)
    if (x >= r.x && y >= r.y && x < r.x + r.width && y < r.y + r.height) ++count;
  return count;
}

TEST(TileMask, NothingIsMarkedAtFirstAndAnEmptyPictureHasNoTiles) {
  const TileMask mask(100, 70);
  EXPECT_TRUE(mask.empty());
  EXPECT_TRUE(mask.rectangles().empty());
  EXPECT_TRUE(mask.bounds().empty());
  TileMask none(0, -3);
  none.mark_all();
  EXPECT_TRUE(none.empty());
  EXPECT_EQ(none.share(), 0);
}

TEST(TileMask, AllIsThePictureEvenWhenTilesReachOverItsEdge) {
  TileMask mask(100, 70);
  mask.mark_all();
  const Viewport b = mask.bounds();
  EXPECT_EQ(b.width, 100);
  EXPECT_EQ(b.height, 70);
  EXPECT_EQ(mask.rectangles().size(), 1u);
  EXPECT_DOUBLE_EQ(mask.share(), 1);
}

TEST(TileMask, WhatIsNotFiniteMarksAll) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const auto& [a, r] :
       {std::pair{Vector2d(nan, 0), 1.0}, std::pair{Vector2d(0, 0), HUGE_VAL}}) {
    TileMask mask(100, 70);
    mask.mark(a, {3, 3}, r);
    EXPECT_DOUBLE_EQ(mask.share(), 1);
    EXPECT_TRUE(mask.reaches(a, r));
  }
}

TEST(TileMask, FarOutsideMarksNothing) {
  TileMask mask(100, 70);
  mask.mark({-500, 1e12}, {-400, 1e12}, 20);
  EXPECT_TRUE(mask.empty());
}

TEST(TileMask, EveryPixelNearTheSegmentLiesInOneRectangle) {
  Random random(31);
  for (int round = 0; round < 300; ++round) {
    const int width = 40 + round, height = 30 + 2 * round;
    TileMask mask(width, height);
    const Vector2d a(random.uniform(-100, width + 100.0), random.uniform(-100, height + 100.0));
    const Vector2d b(random.uniform(-100, width + 100.0), random.uniform(-100, height + 100.0));
    const double radius = random.uniform(0, 60);
    mask.mark(a, b, radius);
    const auto rectangles = mask.rectangles();
    for (int sample = 0; sample < 60; ++sample) {
      const double s = random.uniform(0, 1), angle = random.uniform(0, 6.28);
      const double r = radius * random.uniform(0, 1);
      const Vector2d p = a + s * (b - a) + r * Vector2d(std::cos(angle), std::sin(angle));
      const int x = static_cast<int>(std::floor(p.x())), y = static_cast<int>(std::floor(p.y()));
      if (x < 0 || y < 0 || x >= width || y >= height) continue;
      EXPECT_EQ(holders(rectangles, x, y), 1);
      EXPECT_TRUE(mask.reaches(p, 0));
    }
    for (const Viewport& rect : rectangles) {
      EXPECT_LE(rect.x + rect.width, width);
      EXPECT_LE(rect.y + rect.height, height);
      EXPECT_FALSE(rect.empty());
    }
  }
}

TEST(TileMask, AddAndKeep) {
  TileMask left(320, 64), right(320, 64);
  left.mark({16, 16}, {120, 16}, 1);
  right.mark({80, 16}, {300, 16}, 1);
  TileMask both = left, either = left;
  both.keep(right);
  either.add(right);
  EXPECT_TRUE(both.reaches({90, 16}, 0));
  EXPECT_FALSE(both.reaches({20, 16}, 0));
  EXPECT_FALSE(both.reaches({280, 16}, 0));
  EXPECT_TRUE(either.reaches({20, 16}, 0));
  EXPECT_TRUE(either.reaches({280, 16}, 0));
}

}  // namespace
}  // namespace osteon
