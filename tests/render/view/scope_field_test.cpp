#include "view/scope_field.h"

#include <gtest/gtest.h>

#include <cmath>

namespace osteon {
namespace {

constexpr double kHalf = 0.7, kNear_m = 0.0003;

TEST(ScopeField, ShowsNothingBehindTheEye) {
  for (const double round : {1.0, 2.0}) {
    const ScopeField field(kHalf, round);
    EXPECT_FALSE(field.shows(Vec3(0, 0, 0.01), 0.001, kNear_m));
    EXPECT_FALSE(field.shows(Vec3(0, 0, 0), kNear_m, kNear_m));
    EXPECT_TRUE(field.shows(Vec3(0, 0, 0.01), 0.011, kNear_m));
    EXPECT_TRUE(field.shows(Vec3(0, 0, -0.01), 0, kNear_m));
  }
}

TEST(ScopeField, ShowsTheSquaresCornersWhereItIsNotRound) {
  const Vec3 corner(0.95 * kHalf * 0.01, -0.95 * kHalf * 0.01, -0.01);
  EXPECT_TRUE(ScopeField(kHalf, 1.5).shows(corner, 0, kNear_m));
  EXPECT_FALSE(ScopeField(kHalf, 1.1).shows(corner, 0, kNear_m));
  EXPECT_FALSE(ScopeField(kHalf, 1.5).shows(Vec3(1.05 * kHalf * 0.01, 0, -0.01), 0, kNear_m));
}

// A ball is seen as soon as any of its points is, and is left out soon after none is.
TEST(ScopeField, ABallIsSeenUntilItHasLeftTheField) {
  constexpr double kRadius_m = 0.002, kShare = 1.1;
  const ScopeField field(kHalf, kShare);
  const double widest = kHalf * kShare;
  int seen = 0, left_out = 0;
  for (int a = 0; a < 12; ++a)
    for (int k = 0; k < 60; ++k) {
      const double turn = a * 0.53, off_m = 0.0005 * k;
      const Vec3 center(off_m * std::cos(turn), off_m * std::sin(turn), -0.012);
      // The point of the ball that comes nearest to the field's middle, seen from the eye.
      const double off_rad =
          std::atan2(off_m, 0.012) - std::asin(kRadius_m / std::hypot(off_m, 0.012));
      const bool touches = std::tan(off_rad) < widest;
      const bool shows = field.shows(center, kRadius_m, kNear_m);
      EXPECT_TRUE(shows || !touches) << off_m;
      EXPECT_FALSE(shows && std::tan(off_rad - 0.02) > widest) << off_m;
      (shows ? seen : left_out) += 1;
    }
  EXPECT_GT(seen, 100);
  EXPECT_GT(left_out, 100);
}

}  // namespace
}  // namespace osteon
