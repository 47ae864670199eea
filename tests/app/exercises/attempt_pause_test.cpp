#include "exercises/attempt_pause.h"

#include <gtest/gtest.h>

namespace osteon {
namespace {

TEST(AttemptPause, TicksAreInOneOrLaterByWhatWentBefore) {
  EXPECT_FALSE(paused_at({}, 5).in_pause);
  const std::vector<AttemptPause> pauses{{10, 20}, {30, 30}, {40}};
  EXPECT_EQ(paused_at(pauses, 9).before, 0u);
  EXPECT_FALSE(paused_at(pauses, 9).in_pause);
  EXPECT_TRUE(paused_at(pauses, 10).in_pause);
  EXPECT_TRUE(paused_at(pauses, 19).in_pause);
  EXPECT_FALSE(paused_at(pauses, 20).in_pause);
  EXPECT_EQ(paused_at(pauses, 39).before, 10u);
  EXPECT_TRUE(paused_at(pauses, 1u << 30).in_pause);
}

TEST(AttemptPause, AreKeptAsTextAndReadStrictly) {
  const std::vector<AttemptPause> pauses{{10, 20}, {40}};
  const auto back = parse_pauses(to_text(pauses), "r.osr");
  ASSERT_TRUE(back) << back.error().message();
  EXPECT_EQ(*back, pauses);
  EXPECT_TRUE(parse_pauses("", "r.osr")->empty());
  for (const char* bad : {"1", "1 2", "1 x\n", "-1 2\n", "5 4\n", "5 9\n8 12\n", "1 2 3\n"})
    EXPECT_FALSE(parse_pauses(bad, "r.osr")) << bad;
}

}  // namespace
}  // namespace osteon
