#include "osteon/procedure/stump_watch.h"

#include <gtest/gtest.h>

namespace osteon {
namespace {

BoneSnapshot cleared(double percent) {
  BoneSnapshot bones;
  bones.cleared_percent = percent;
  return bones;
}

TEST(StumpWatch, WhereNothingIsFeltItTellsNothing) {
  StumpWatch watch;
  std::vector<Event> events;
  for (std::uint64_t tick = 1; tick <= 2 * kTellStumps; ++tick)
    watch.add(tick, cleared(-1), events);
  EXPECT_TRUE(events.empty());
  EXPECT_FALSE(watch.percent());
}

TEST(StumpWatch, WholePercentsAreToldOnceAndAgainForALaterStage) {
  StumpWatch watch;
  std::vector<Event> events;
  watch.add(1, cleared(0.4), events);
  EXPECT_TRUE(events.empty());
  EXPECT_EQ(watch.percent(), 0);
  watch.add(2, cleared(37.9), events);
  watch.add(3, cleared(37.95), events);
  ASSERT_EQ(events.size(), 1u);
  EXPECT_EQ(events[0].kind, kStumpsCleared);
  EXPECT_EQ(events[0].tick, 2u);
  EXPECT_EQ(events[0].values[0], 37);
  EXPECT_EQ(watch.percent(), 37);
  watch.add(kTellStumps, cleared(37.95), events);
  EXPECT_EQ(events.size(), 2u);
}

TEST(StumpWatch, ARestorePointBringsThemBack) {
  StumpWatch watch;
  std::vector<Event> events;
  watch.add(1, cleared(50), events);
  watch.add(2, cleared(0), events);
  ASSERT_EQ(events.size(), 2u);
  EXPECT_EQ(events[1].values[0], 0);
}

}  // namespace
}  // namespace osteon
