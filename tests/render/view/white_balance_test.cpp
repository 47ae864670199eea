#include "osteon/render/white_balance.h"

#include <gtest/gtest.h>

#include <cmath>

namespace osteon {
namespace {

/// CIE x and y of a colour in linear sRGB.
Eigen::Vector2d chromaticity(const Vec3& rgb) {
  Mat3 xyz_from_rgb;
  xyz_from_rgb << 0.4124, 0.3576, 0.1805, 0.2126, 0.7152, 0.0722, 0.0193, 0.1192, 0.9505;
  const Vec3 xyz = xyz_from_rgb * rgb;
  return {xyz.x() / xyz.sum(), xyz.y() / xyz.sum()};
}

TEST(WhiteBalance, NumbersThatAreNoneOrOutOfRangeAreTakenAsTheNearest) {
  EXPECT_EQ(light_color(std::nan("")), light_color(kScopeLamp_k));
  EXPECT_EQ(light_color(0), light_color(kLeastLamp_k));
  EXPECT_EQ(light_color(1e9), light_color(kMostLamp_k));
  EXPECT_TRUE(shown_white({std::nan(""), -1}).allFinite());
}

// Standard illuminant A is a black body of 2856 K (CIE 15): x 0.44758, y 0.40745; that of 6500 K
// lies at 0.3135, 0.3237.
TEST(WhiteBalance, BlackBodiesHaveTheChromaticitiesOfTheTables) {
  const auto a = chromaticity(light_color(2856)), d = chromaticity(light_color(6500));
  EXPECT_NEAR(a.x(), 0.44758, 0.001);
  EXPECT_NEAR(a.y(), 0.40745, 0.001);
  EXPECT_NEAR(d.x(), 0.3135, 0.001);
  EXPECT_NEAR(d.y(), 0.3237, 0.001);
  for (double k = kLeastLamp_k; k <= kMostLamp_k; k += 100)
    EXPECT_NEAR(Vec3(0.2126, 0.7152, 0.0722).dot(light_color(k)), 1, 1e-12) << k;
}

TEST(WhiteBalance, WhiteIsWhiteInTheLightThatTheCameraWasBalancedTo) {
  for (const double k : {2500.0, 3200.0, 5600.0, 9000.0}) {
    const Eigen::Vector3f shown = shown_white({k, k}).cast<float>();
    EXPECT_EQ(shown, Eigen::Vector3f::Ones()) << k;
  }
}

TEST(WhiteBalance, WarmLightIsOrangeToACameraOfDaylightAndColdLightBlueToOneOfHalogen) {
  const Vec3 warm = shown_white({3200, 5600}), cold = shown_white({5600, 3200});
  EXPECT_GT(warm.x(), 1.3 * warm.y());
  EXPECT_LT(warm.z(), 0.7 * warm.y());
  EXPECT_LT(cold.x(), 0.9 * cold.y());
  EXPECT_GT(cold.z(), 1.3 * cold.y());
  // The one undoes the other.
  const Vec3 both = warm.cwiseProduct(cold);
  EXPECT_LT((both / both.y() - Vec3::Ones()).norm(), 1e-9);
}

}  // namespace
}  // namespace osteon
