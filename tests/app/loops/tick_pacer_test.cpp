#include "loops/tick_pacer.h"

#include <gtest/gtest.h>

#include "osteon/base/random.h"

namespace osteon {
namespace {

constexpr std::int64_t kMs = 1'000'000;

TEST(TickPacer, KeepsAnEvenGridWhenOnTime) {
  TickPacer pacer(kMs);
  pacer.start(500);
  for (std::int64_t i = 1; i <= 1000; ++i)
    EXPECT_EQ(pacer.next(500 + (i - 1) * kMs), 500 + i * kMs);
  EXPECT_EQ(pacer.missed(), 0u);
}

TEST(TickPacer, ALittleLateIsNotMissed) {
  TickPacer pacer(kMs);
  pacer.start(0);
  EXPECT_EQ(pacer.next(kMs + kMs / 2), kMs);
  EXPECT_EQ(pacer.next(kMs + kMs / 2), 2 * kMs);
  EXPECT_EQ(pacer.missed(), 0u);
}

TEST(TickPacer, AStallSkipsAndCountsButRunsNoBurst) {
  TickPacer pacer(kMs);
  pacer.start(0);
  const std::int64_t after_stall = 10 * kMs + kMs / 4;
  EXPECT_EQ(pacer.next(after_stall), 10 * kMs);
  EXPECT_EQ(pacer.missed(), 9u);
  EXPECT_EQ(pacer.next(after_stall), 11 * kMs);
}

TEST(TickPacer, TicksAndMissedAddUpToTheTimeGone) {
  TickPacer pacer(kMs);
  pacer.start(0);
  Random random(3);
  std::int64_t now = 0;
  std::int64_t ticks = 0;
  for (int i = 0; i < 5000; ++i) {
    const std::int64_t deadline = pacer.next(now);
    EXPECT_EQ(deadline % kMs, 0);
    EXPECT_GT(deadline, now - kMs);
    ++ticks;
    now = std::max(now, deadline) + static_cast<std::int64_t>(random.uniform(0, 3e6));
    EXPECT_EQ(deadline, (ticks + static_cast<std::int64_t>(pacer.missed())) * kMs);
  }
}

}  // namespace
}  // namespace osteon
