#include "osteon/procedure/graft_watch.h"

#include <gtest/gtest.h>

#include "graft_bench_case.h"

namespace osteon {
namespace {

using testing::bench_case;
using testing::folded_bench;

std::vector<Event> told_of(GraftWatch& watch, const GraftBenchState& state) {
  BoneSnapshot bones;
  bones.bench = state;
  std::vector<Event> out;
  watch.add(5, bones, out);
  return out;
}

TEST(GraftWatch, TellsOnceWhatHappened) {
  GraftWatch watch(*bench_case());
  GraftBenchState state;
  state.on = true;
  EXPECT_TRUE(told_of(watch, state).empty());
  state.tendons[0].bands_cut = 0b01;
  auto told = told_of(watch, state);
  ASSERT_EQ(told.size(), 1u);
  EXPECT_EQ(told[0].kind, kBandCut);
  EXPECT_EQ(told[0].values[0], 2);
  state.tendons[0].stripped = state.tendons[0].amputated = true;
  told = told_of(watch, state);
  ASSERT_EQ(told.size(), 1u);
  EXPECT_EQ(told[0].kind, kTendonStripped);
  EXPECT_NEAR(told[0].values[0], 85, 1e-9);
  EXPECT_EQ(told[0].values[1], 1);
  EXPECT_TRUE(told_of(watch, state).empty());
}

TEST(GraftWatch, TellsOfFasciaOfTendonsThatAreFoundAndOfWhatIsHurt) {
  const auto the_case = bench_case(testing::covered_bench_def());
  GraftWatch watch(*the_case);
  GraftBenchState state = fresh_bench(*find_graft_bench(*the_case));
  EXPECT_TRUE(told_of(watch, state).empty());
  state.slit = 0b111;
  auto told = told_of(watch, state);
  ASSERT_EQ(told.size(), 1u);
  EXPECT_EQ(told[0].kind, kFasciaOpened);
  EXPECT_NEAR(told[0].values[0], 3, 1e-9);
  state.slit = 0b100111;  // no longer in one piece
  EXPECT_TRUE(told_of(watch, state).empty());
  state.tendons[1].found = true;
  told = told_of(watch, state);
  ASSERT_EQ(told.size(), 1u);
  EXPECT_EQ(told[0].kind, kTendonFound);
  EXPECT_EQ(told[0].values[0], 1);
  state.tendons[0].found = true;
  EXPECT_EQ(told_of(watch, state).at(0).values[0], 2);
  state.hurt = kMclHurt;
  told = told_of(watch, state);
  ASSERT_EQ(told.size(), 1u);
  EXPECT_EQ(told[0].kind, kByFasciaHurt);
  EXPECT_EQ(told[0].values[0], 0);
  state.hurt |= kNerveHurt;
  EXPECT_EQ(told_of(watch, state).at(0).values[0], 1);
  EXPECT_TRUE(told_of(watch, state).empty());
}

TEST(GraftWatch, MeasuresWhenTheLoopIsHung) {
  GraftWatch watch(*bench_case());
  GraftBenchState state = folded_bench(2, 2);
  (void)told_of(watch, state);
  state.loop_m = 0.015;
  state.creep_s = 240;
  const auto told = told_of(watch, state);
  // The tension's time as well; but for what a knee's tunnels have to do with it.
  ASSERT_EQ(told.size(), 1 + kGraftValueNames.size());
  EXPECT_EQ(told.back().kind, kLoopHung);
  EXPECT_EQ(told.back().values[2], 0);  // the button cannot turn
  EXPECT_NEAR(told.back().values[1], 25, 1e-9);
  EXPECT_EQ(told[0].kind, kGraftTensioned);
  EXPECT_EQ(told[1].kind, kGraftMeasured);
  EXPECT_NEAR(told[1].values[1], 8, 1e-9);
  EXPECT_NEAR(told[5].values[1], 100 * creep_left(240), 1e-9);
}

TEST(GraftWatch, TellsOfMuscleInTenthsAndOfThread) {
  GraftWatch watch(*bench_case());
  GraftBenchState state;
  state.on = true;
  (void)told_of(watch, state);
  state.tendons[0].stripped = state.tendons[1].stripped = true;
  (void)told_of(watch, state);
  state.tendons[0].scraped_m = 0.05 * kScrapedClean_m;
  auto told = told_of(watch, state);
  ASSERT_EQ(told.size(), 1u);
  EXPECT_EQ(told[0].kind, kMuscleScraped);
  EXPECT_EQ(told[0].values[0], 100);  // of the other
  state.tendons[0].scraped_m = 0.06 * kScrapedClean_m;
  EXPECT_TRUE(told_of(watch, state).empty());
  for (TendonOnBench& tendon : state.tendons) tendon.scraped_m = kScrapedClean_m;
  told = told_of(watch, state);
  ASSERT_EQ(told.size(), 1u);
  EXPECT_EQ(told[0].values[0], 0);
  state.tendons[0].stitches = 0b1111;
  state.tendons[1].stitches = 0b11;
  told = told_of(watch, state);
  ASSERT_EQ(told.size(), 1u);
  EXPECT_EQ(told[0].kind, kTendonStitched);
  EXPECT_EQ(told[0].values[0], 2);
}

// In a knee the channel is what was drilled there.
TEST(GraftWatch, ALoopIsJudgedOnceTheTunnelsAreMeasured) {
  GraftWatch watch(*bench_case());
  watch.set_room(std::nullopt);
  GraftBenchState state = folded_bench(2, 2);
  (void)told_of(watch, state);
  state.loop_m = 0.015;
  EXPECT_TRUE(told_of(watch, state).empty());
  watch.set_room(GraftRoom{0.033, 0.025, 0.0085, 0.009});
  auto told = told_of(watch, state);
  ASSERT_EQ(told.size(), 1 + kGraftValueNames.size());
  EXPECT_EQ(told.back().kind, kLoopHung);
  EXPECT_NEAR(told.back().values[1], 18, 1e-9);
  EXPECT_EQ(told.back().values[2], 1);
  const Event& over = told[told.size() - 2];
  EXPECT_EQ(kGraftValueNames[static_cast<std::size_t>(over.values[0])], "tunnel_over_graft_mm");
  EXPECT_NEAR(over.values[1], 1, 1e-6);  // a graft that passes 8 mm
  EXPECT_TRUE(told_of(watch, state).empty());
  state.loop_m = 0.020;  // another one is told again, and one after a restore point
  EXPECT_FALSE(told_of(watch, state).empty());
  state.loop_m = 0;
  EXPECT_TRUE(told_of(watch, state).empty());
  state.loop_m = 0.020;
  EXPECT_FALSE(told_of(watch, state).empty());
}

TEST(GraftWatch, IsSilentWithoutABench) {
  Case none;
  GraftWatch watch(none);
  EXPECT_TRUE(told_of(watch, folded_bench(2, 2)).empty());
}

}  // namespace
}  // namespace osteon
