#include "view/water_clouds.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <numeric>

namespace osteon {
namespace {

constexpr int kSide = 32;

int at(const std::vector<std::uint8_t>& values, int x, int y, int z) {
  return values[static_cast<std::size_t>((z * kSide + y) * kSide + x)];
}

TEST(WaterClouds, HangAboutTheMeanAndVary) {
  const auto values = water_clouds(kSide);
  ASSERT_EQ(values.size(), static_cast<std::size_t>(kSide * kSide * kSide));
  const double mean = std::accumulate(values.begin(), values.end(), 0.0) / values.size();
  EXPECT_NEAR(mean, 127.5, 8);
  EXPECT_LT(*std::min_element(values.begin(), values.end()), 90);
  EXPECT_GT(*std::max_element(values.begin(), values.end()), 165);
  EXPECT_EQ(values, water_clouds(kSide));
}

// From the last layer to the first there is no more of a step than within.
TEST(WaterClouds, RepeatWithoutASeam) {
  const auto values = water_clouds(kSide);
  int within = 0, across[3] = {};
  for (int a = 0; a < kSide; ++a)
    for (int b = 0; b < kSide; ++b) {
      for (int x = 0; x + 1 < kSide; ++x)
        within = std::max(within, std::abs(at(values, x, a, b) - at(values, x + 1, a, b)));
      across[0] = std::max(across[0], std::abs(at(values, kSide - 1, a, b) - at(values, 0, a, b)));
      across[1] = std::max(across[1], std::abs(at(values, a, kSide - 1, b) - at(values, a, 0, b)));
      across[2] = std::max(across[2], std::abs(at(values, a, b, kSide - 1) - at(values, a, b, 0)));
    }
  for (const int step : across) EXPECT_LE(step, within);
}

TEST(WaterClouds, OfNoSizeThereAreNone) { EXPECT_TRUE(water_clouds(0).empty()); }

}  // namespace
}  // namespace osteon
