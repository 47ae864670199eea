#include "causality.h"

#include <gtest/gtest.h>

namespace osteon {
namespace {

// bone_step of each tick and tool_ticks[0] of each step.
Recording recording_of(const std::vector<std::uint64_t>& bone_steps,
                       const std::vector<std::uint64_t>& tool_ticks) {
  Recording r;
  for (const std::uint64_t s : bone_steps) {
    r.ticks.emplace_back();
    r.ticks.back().tick = r.ticks.size();
    r.ticks.back().bone_step = s;
  }
  for (const std::uint64_t t : tool_ticks) {
    r.steps.emplace_back();
    r.steps.back().step = r.steps.size();
    r.steps.back().tool_ticks[0] = t;
  }
  return r;
}

TEST(Causality, AnEmptyRecordingIsSound) { EXPECT_TRUE(check_consumption(recording_of({}, {}))); }

TEST(Causality, EitherClockMayRunAhead) {
  EXPECT_TRUE(check_consumption(recording_of({0, 0, 1, 1, 2, 2}, {2, 4, 6})));
  EXPECT_TRUE(check_consumption(recording_of({4, 4, 4}, {0, 0, 0, 0})));  // physics first
  EXPECT_TRUE(check_consumption(recording_of({0, 0, 0, 0}, {4, 4})));     // haptic first
  EXPECT_TRUE(check_consumption(recording_of({0, 0, 0, 3, 3, 5}, {1, 1, 2, 3, 3, 6})));
}

TEST(Causality, RefusesWhatIsNotThere) {
  EXPECT_FALSE(check_consumption(recording_of({0, 2}, {1})));
  EXPECT_FALSE(check_consumption(recording_of({0, 0}, {3})));
}

TEST(Causality, RefusesNumbersOutOfTurn) {
  Recording r = recording_of({0, 0, 0}, {1, 2});
  r.ticks[1].tick = 3;
  EXPECT_FALSE(check_consumption(r));
  r = recording_of({0, 0, 0}, {1, 2});
  r.steps[0].step = 0;
  EXPECT_FALSE(check_consumption(r));
}

TEST(Causality, RefusesTimeThatRunsBackwards) {
  EXPECT_FALSE(check_consumption(recording_of({0, 2, 1}, {0, 0})));
  EXPECT_FALSE(check_consumption(recording_of({0, 0, 0}, {2, 1})));
}

TEST(Causality, RefusesATickThatConsumedItsOwnEffect) {
  EXPECT_FALSE(check_consumption(recording_of({1}, {1})));
  EXPECT_FALSE(check_consumption(recording_of({0, 1, 1}, {3})));
  EXPECT_TRUE(check_consumption(recording_of({0, 1}, {1})));
}

TEST(Causality, TrimmingLeavesASoundPrefix) {
  // Tick 4 consumed step 3, which was not saved; step 2 consumed tick 3, which stays.
  Recording r = recording_of({0, 0, 1, 3, 3}, {2, 3});
  trim_to_saved(r);
  EXPECT_EQ(r.ticks.size(), 3u);
  EXPECT_EQ(r.steps.size(), 2u);
  EXPECT_TRUE(check_consumption(r));

  // Steps that consumed a lost tick go as well.
  r = recording_of({0, 0, 5}, {1, 2, 3, 4});
  trim_to_saved(r);
  EXPECT_EQ(r.ticks.size(), 2u);
  EXPECT_EQ(r.steps.size(), 2u);
  EXPECT_TRUE(check_consumption(r));
}

TEST(Causality, TrimmingLeavesAWholeRecordingAlone) {
  Recording r = recording_of({0, 0, 1, 1}, {2, 4});
  trim_to_saved(r);
  EXPECT_EQ(r.ticks.size(), 4u);
  EXPECT_EQ(r.steps.size(), 2u);
}

}  // namespace
}  // namespace osteon
