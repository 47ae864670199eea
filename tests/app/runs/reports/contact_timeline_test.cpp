#include "runs/reports/contact_timeline.h"

#include <gtest/gtest.h>

#include "runs/reports/force_history.h"

namespace osteon {
namespace {

TEST(ContactTimeline, NothingTouchedLeavesNoSpan) {
  ContactTimeline line;
  for (int i = 0; i < 100; ++i) line.add(0.004 * i, 0, 0);
  EXPECT_TRUE(line.spans().empty());
  EXPECT_NEAR(line.end_s(), 0.396, 1e-12);
}

TEST(ContactTimeline, AShortBreakDoesNotEndASpanALongOneDoes) {
  ContactTimeline line;
  line.add(1.00, 1, 0.5f);
  line.add(1.04, 1, 2.0f);  // 40 ms later: the same touch
  line.add(1.10, 1, 1.0f);  // 60 ms later: another
  ASSERT_EQ(line.spans().size(), 2u);
  EXPECT_DOUBLE_EQ(line.spans()[0].end_s, 1.04);
  EXPECT_FLOAT_EQ(line.spans()[0].peak_force_n, 2.0f);
  EXPECT_DOUBLE_EQ(line.spans()[1].start_s, 1.10);
}

TEST(ContactTimeline, BonesTouchedTogetherHaveSpansOfTheirOwn) {
  ContactTimeline line;
  const std::uint64_t both = (1ull << 3) | (1ull << 63);
  line.add(2.0, both, 1);
  line.add(2.02, 1ull << 63, 1);
  ASSERT_EQ(line.spans().size(), 2u);
  EXPECT_EQ(line.spans()[0].bone, BoneId{3});
  EXPECT_EQ(line.spans()[1].bone, BoneId{63});
  EXPECT_DOUBLE_EQ(line.spans()[0].end_s, 2.0);
  EXPECT_DOUBLE_EQ(line.spans()[1].end_s, 2.02);
  line.clear();
  EXPECT_TRUE(line.spans().empty());
}

TEST(ForceHistory, HoldsTheNewestValuesOldestFirst) {
  ForceHistory history(0.04);  // ten values
  ASSERT_EQ(history.values().size(), 10u);
  for (int i = 1; i <= 37; ++i) {
    history.add(static_cast<float>(i));
    ASSERT_EQ(history.values().size(), 10u);
    EXPECT_EQ(history.values().back(), static_cast<float>(i));
    EXPECT_EQ(history.values().front(), static_cast<float>(std::max(0, i - 9)));
  }
  history.clear();
  for (const float v : history.values()) EXPECT_EQ(v, 0);
}

}  // namespace
}  // namespace osteon
