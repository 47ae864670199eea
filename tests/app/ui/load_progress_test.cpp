#include "ui/load_progress.h"

#include <gtest/gtest.h>

#include <limits>

namespace osteon {
namespace {

TEST(SecondsLeft, SaysNothingBeforeItCanKnow) {
  EXPECT_EQ(seconds_left(0, 0), -1);
  EXPECT_EQ(seconds_left(0.2, 0.5), -1);
  EXPECT_EQ(seconds_left(10, 0.01), -1);
  EXPECT_EQ(seconds_left(10, 1.5), -1);
  EXPECT_EQ(seconds_left(std::numeric_limits<double>::quiet_NaN(), 0.5), -1);
  EXPECT_EQ(seconds_left(10, std::numeric_limits<double>::quiet_NaN()), -1);
}

TEST(SecondsLeft, CarriesThePaceOn) {
  EXPECT_DOUBLE_EQ(seconds_left(2, 0.5), 2);
  EXPECT_DOUBLE_EQ(seconds_left(3, 0.75), 1);
  EXPECT_DOUBLE_EQ(seconds_left(4, 1), 0);
}

}  // namespace
}  // namespace osteon
