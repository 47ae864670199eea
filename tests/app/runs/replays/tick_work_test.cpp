// The fastest run of each tick counts, of runs of unlike length too.
#include "runs/replays/tick_work.h"

#include <gtest/gtest.h>

namespace osteon {
namespace {

TEST(TickWork, WithoutATickThereIsNothing) {
  TickWork work;
  work.begin_run();
  EXPECT_EQ(work.hands(), 0u);
  EXPECT_EQ(work.runs(), 1u);
}

TEST(TickWork, TheFastestRunOfEachTickCounts) {
  TickWork work;
  const std::int64_t took_us[2][3] = {{10, 900, 30}, {500, 20, 40}};
  for (const auto& run : took_us) {
    work.begin_run();
    for (const std::int64_t us : run) work.see(1, 1000 * us);
  }
  ASSERT_EQ(work.hands(), 2u);
  EXPECT_EQ(work.of(0).count(), 0u);
  const Percentiles times = work.of(1);
  EXPECT_EQ(times.count(), 3u);
  EXPECT_EQ(times.max_ns(), 30000);
  EXPECT_NEAR(times.quantile_ns(0.5), 20000, 300);
}

TEST(TickWork, ALongerRunAddsItsTicksAndAClockThatGoesBackCountsAsNothing) {
  TickWork work;
  work.begin_run();
  work.see(0, 5000);
  work.begin_run();
  work.see(0, 7000);
  work.see(0, -3);
  EXPECT_EQ(work.of(0).count(), 2u);
  EXPECT_EQ(work.of(0).max_ns(), 5000);
}

TEST(TickWork, IsPrintedByHand) {
  TickWork work;
  work.begin_run();
  work.see(0, 4000);
  work.see(1, 8000);
  const std::string text = to_text(work, {"scope", "probe"});
  EXPECT_NE(text.find("fastest of 1 runs"), std::string::npos) << text;
  EXPECT_NE(text.find("scope"), std::string::npos) << text;
  EXPECT_NE(text.find("p99.9 8.0, max 8.0"), std::string::npos) << text;
}

}  // namespace
}  // namespace osteon
