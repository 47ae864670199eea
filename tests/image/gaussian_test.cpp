#include "osteon/image/gaussian.h"

#include <gtest/gtest.h>

#include "volumes.h"

namespace osteon {
namespace {

GridFrame cube(int n) {
  GridFrame frame;
  frame.size = {n, n, n};
  frame.spacing_m = Vec3(0.001, 0.001, 0.002);
  return frame;
}

TEST(Gaussian, ZeroLeavesTheVolumeAlone) {
  Volume volume = noise_volume(cube(6), 3);
  const Volume before = volume;
  blur_gaussian(volume, 0);
  EXPECT_EQ(volume.values, before.values);
}

TEST(Gaussian, KeepsAConstantUpToTheRim) {
  Volume volume{cube(7), std::vector<std::int16_t>(343, -700)};
  blur_gaussian(volume, 0.002);
  for (const auto v : volume.values) EXPECT_EQ(v, -700);
}

TEST(Gaussian, APointSpreadsByItsDeviationInMetresOnEveryAxis) {
  Volume volume{cube(25), std::vector<std::int16_t>(15625, 0)};
  volume.at(12, 12, 12) = 30000;
  blur_gaussian(volume, 0.002);
  double sum = 0;
  Vec3 square = Vec3::Zero();
  for (int k = 0; k < 25; ++k)
    for (int j = 0; j < 25; ++j)
      for (int i = 0; i < 25; ++i) {
        const Vec3 d = volume.frame.spacing_m.cwiseProduct(Vec3(i - 12, j - 12, k - 12));
        sum += volume.at(i, j, k);
        square += volume.at(i, j, k) * d.cwiseAbs2();
      }
  EXPECT_NEAR(sum, 30000, 1500);
  for (int a = 0; a < 3; ++a) EXPECT_NEAR(std::sqrt(square[a] / sum), 0.002, 0.0002);
}

}  // namespace
}  // namespace osteon
