#include "osteon/base/percentiles.h"

#include <gtest/gtest.h>

namespace osteon {
namespace {

TEST(Percentiles, NothingAddedIsZero) {
  EXPECT_EQ(Percentiles{}.quantile_ns(0.5), 0);
  EXPECT_EQ(Percentiles{}.max_ns(), 0);
}

TEST(Percentiles, NonPositiveAndHugeDurationsAreKeptInRange) {
  Percentiles p;
  p.add_ns(0);
  p.add_ns(-5);
  p.add_ns(1'000'000'000'000'000);
  EXPECT_EQ(p.count(), 3u);
  EXPECT_EQ(p.max_ns(), 1e15);
}

TEST(Percentiles, QuantilesOfAKnownSetWithinABin) {
  Percentiles p;
  for (int i = 1; i <= 10000; ++i) p.add_ns(i * 100);
  EXPECT_NEAR(p.quantile_ns(0.5), 500e3, 500e3 * 0.011);
  EXPECT_NEAR(p.quantile_ns(0.99), 990e3, 990e3 * 0.011);
  EXPECT_EQ(p.quantile_ns(1), 1e6);
}

}  // namespace
}  // namespace osteon
