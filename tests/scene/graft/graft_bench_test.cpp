#include "osteon/scene/graft_bench.h"

#include <gtest/gtest.h>

#include "graft_bench_case.h"

namespace osteon {
namespace {

using testing::bench_case;
using testing::bench_def;
using testing::folded_bench;

TEST(GraftBench, IsFoundByItsMarks) {
  const auto plan = find_graft_bench(*bench_case());
  ASSERT_TRUE(plan);
  EXPECT_NEAR(plan->tendons[0].measures.length_m, 0.280, 1e-12);
  EXPECT_NEAR(plan->tendons[0].measures.area_m2, 13.72e-6, 0.01e-6);
  ASSERT_EQ(plan->tendons[0].measures.bands, 2u);
  EXPECT_NEAR(plan->tendons[0].measures.bands_m[1], 0.085, 1e-12);
  EXPECT_EQ(plan->tendons[1].measures.bands, 1u);
  EXPECT_NEAR(plan->channel_m, 0.040, 1e-12);
  EXPECT_NEAR(plan->socket_m, 0.026, 1e-12);
  EXPECT_NEAR((plan->end_W(1) - Vec3(0.260, -0.012, -0.008)).norm(), 0, 1e-12);
  EXPECT_EQ(plan->bones[GraftBenchPlan::kBoard], 2u);
}

TEST(GraftBench, IsNoneWhereAMarkOrABoneIsMissing) {
  for (const char* name : {"gr_end", "hook", "socket_to", "fold_3"}) {
    CaseDef def = bench_def();
    std::erase_if(def.landmarks, [&](const auto& mark) { return mark.name == name; });
    EXPECT_FALSE(find_graft_bench(*bench_case(std::move(def)))) << name;
  }
  CaseDef def = bench_def();
  def.bones[1].name = "rod";
  EXPECT_FALSE(find_graft_bench(*bench_case(std::move(def))));
}

TEST(GraftBench, GivesWhatWasHarvestedAndFolded) {
  const auto plan = find_graft_bench(*bench_case());
  ASSERT_TRUE(plan);
  GraftBenchState state = folded_bench(2, 2);
  ASSERT_TRUE(graft_on(*plan, state));
  EXPECT_NEAR(graft_on(*plan, state)->length_m, 0.125, 1e-12);
  state.tendons[0].amputated = true;
  state.tendons[0].bands_cut = 0b01;
  EXPECT_NEAR(harvested(*plan, state, 0)->length_m, 0.085, 1e-12);
  EXPECT_NEAR(graft_on(*plan, state)->length_m, 0.0375, 1e-12);
  state.tendons[0].stripped = state.tendons[1].stripped = false;
  EXPECT_FALSE(graft_on(*plan, state));
  EXPECT_FALSE(harvested(*plan, GraftBenchState{}, 0));
}

TEST(GraftBench, FasciaIsThereWhereBothItsMarksAre) {
  const auto bare = find_graft_bench(*bench_case());
  ASSERT_TRUE(bare);
  EXPECT_FALSE(bare->is_covered());
  EXPECT_TRUE(fresh_bench(*bare).tendons[0].found);
  EXPECT_EQ(fascia_open_m(*bare, fresh_bench(*bare)), 0);
  CaseDef half = testing::covered_bench_def();
  half.landmarks.pop_back();
  EXPECT_FALSE(find_graft_bench(*bench_case(std::move(half)))->is_covered());
  const auto plan = find_graft_bench(*bench_case(testing::covered_bench_def()));
  ASSERT_TRUE(plan && plan->is_covered());
  EXPECT_LT((plan->fascia_along_W() - Vec3::UnitX()).norm(), 1e-12);
  EXPECT_LT((plan->fascia_across_W() + Vec3::UnitY()).norm(), 1e-12) << "to the gracilis";
  EXPECT_LT((plan->fascia_up_W() - Vec3::UnitZ()).norm(), 1e-12);
  EXPECT_LT((found_at_W(*plan, 0) - Vec3(0.024, 0.012, 0)).norm(), 1e-12);
  EXPECT_LT((found_at_W(*plan, 1) - Vec3(0.024, -0.012, 0)).norm(), 1e-12);
}

TEST(GraftBench, TheLongestOpenStretchOfTheFasciaCounts) {
  const auto plan = find_graft_bench(*bench_case(testing::covered_bench_def()));
  ASSERT_TRUE(plan);
  GraftBenchState state = fresh_bench(*plan);
  EXPECT_FALSE(state.tendons[0].found || state.tendons[1].found);
  EXPECT_EQ(fascia_open_m(*plan, state), 0);
  state.slit = 0b0111011;
  EXPECT_NEAR(fascia_open_m(*plan, state), 0.003, 1e-12);
  state.slit = kFasciaOpen;
  EXPECT_NEAR(fascia_open_m(*plan, state), 0.036, 1e-12);
}

TEST(GraftBench, MuscleThatIsLeftMakesTheGraftThicker) {
  const auto plan = find_graft_bench(*testing::bench_case());
  ASSERT_TRUE(plan);
  GraftBenchState clean = testing::folded_bench(2, 2), left = clean;
  for (TendonOnBench& tendon : left.tendons) tendon.scraped_m = 0;
  const double ratio = graft_on(*plan, left)->diameter_m / graft_on(*plan, clean)->diameter_m;
  EXPECT_NEAR(ratio * ratio, 4.0 / 3, 1e-9);
  EXPECT_EQ(graft_on(*plan, left)->length_m, graft_on(*plan, clean)->length_m);
}

TEST(GraftBench, TheFewestPassesAreThoseOfWhatIsFolded) {
  GraftBenchState state;
  EXPECT_EQ(fewest_passes(state), 0u);
  state.tendons[0].stitches = 0b111;
  EXPECT_EQ(fewest_passes(state), 0u);
  state.tendons[0].folds = 2;
  EXPECT_EQ(fewest_passes(state), 3u);
  state.tendons[1].folds = 2;
  EXPECT_EQ(fewest_passes(state), 0u);
}

}  // namespace
}  // namespace osteon
