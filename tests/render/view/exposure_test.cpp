// The gain of a scope's camera: by the mean, bounded by what is brightest.
#include "view/exposure.h"

#include <gtest/gtest.h>

#include <limits>
#include <vector>

namespace osteon {
namespace {

TEST(Exposure, NothingOrNoNumbersLeaveTheLightAsItIs) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double inf = std::numeric_limits<double>::infinity();
  EXPECT_EQ(exposure_gain({}), 1);
  EXPECT_EQ(exposure_gain(std::vector<double>{nan, inf, -inf}), 1);
  EXPECT_EQ(exposure_gain(std::vector<double>{nan, 0.6, inf}),
            exposure_gain(std::vector<double>{0.6}));
}

TEST(Exposure, BlackIsRaisedNoMoreThanTheCameraCan) {
  EXPECT_EQ(exposure_gain(std::vector<double>(100, 0.0)), 50);
  EXPECT_EQ(exposure_gain(std::vector<double>{-1.0}), 50);
}

TEST(Exposure, AnEvenPictureComesToTheMean) {
  for (const double light : {0.02, 0.3, 5.0}) {
    EXPECT_NEAR(light * exposure_gain(std::vector<double>{light}), kMeanLight, 1e-9);
    EXPECT_NEAR(light * exposure_gain(std::vector<double>(500, light)), kMeanLight, 1e-9);
  }
}

TEST(Exposure, ATenthOfVeryNearTissueStaysBelowWhite) {
  std::vector<double> light(900, 0.05);
  light.insert(light.end(), 100, 8.0);
  EXPECT_NEAR(8.0 * exposure_gain(light), kMostLight, 1e-9);
}

TEST(Exposure, AFewSparksDoNotDarkenThePicture) {
  std::vector<double> light(990, 0.3);
  const double mean = exposure_gain(light);
  light.insert(light.end(), 10, 30.0);
  EXPECT_GT(exposure_gain(light), 0.9 * mean);
}

}  // namespace
}  // namespace osteon
