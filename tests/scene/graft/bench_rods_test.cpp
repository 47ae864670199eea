// What is seen of tendons and graft on a bench.
#include "osteon/scene/bench_rods.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "graft_bench_case.h"

namespace osteon {
namespace {

using Is = BenchRod::Is;

class BenchRods : public ::testing::Test {
 protected:
  GraftBenchPlan plan = *find_graft_bench(*testing::bench_case());
  BoneSnapshot bones;

  std::vector<BenchRod> rods(const GraftBenchState& state) {
    bones.bench = state;
    return bench_rods(plan, bones);
  }
  static std::size_t count(const std::vector<BenchRod>& rods, Is is) {
    return static_cast<std::size_t>(std::count_if(
        rods.begin(), rods.end(), [is](const BenchRod& rod) { return rod.is == is; }));
  }
  static double length(const std::vector<BenchRod>& rods, Is is) {
    double sum = 0;
    for (const BenchRod& rod : rods)
      if (rod.is == is) sum += (rod.b_W - rod.a_W).norm();
    return sum;
  }
  static GraftBenchState fresh() {
    GraftBenchState state;
    state.on = true;
    return state;
  }
};

TEST_F(BenchRods, WithoutABenchThereIsNothing) { EXPECT_TRUE(rods({}).empty()); }

TEST_F(BenchRods, TendonsLieUnderTheSkinWithTheirBands) {
  const auto all = rods(fresh());
  EXPECT_NEAR(length(all, Is::kUnderSkin), 0.280 + 0.260, 1e-9);
  EXPECT_EQ(count(all, Is::kBand), 3u);
  EXPECT_EQ(all.size(), 5u);
  for (const BenchRod& rod : all) EXPECT_GE(rod.a_W.z(), -1e-9) << "inside of the block";
  // Bands leave to the outer side.
  for (const BenchRod& rod : all)
    if (rod.is == Is::kBand) {
      EXPECT_GT(std::abs(rod.b_W.y()), std::abs(rod.a_W.y()));
    }
}

TEST_F(BenchRods, FasciaIsMarkedUntilItIsOpenAndAFoundTendonLiesInALoop) {
  plan = *find_graft_bench(*testing::bench_case(testing::covered_bench_def()));
  GraftBenchState state = fresh_bench(plan);
  auto all = rods(state);
  EXPECT_NEAR(length(all, Is::kMark), 0.036, 1e-9);
  EXPECT_EQ(count(all, Is::kFascia), 0u);
  state.slit = (std::uint64_t{1} << 30) - 1;
  all = rods(state);
  EXPECT_NEAR(length(all, Is::kMark), 0.006, 1e-9);
  EXPECT_NEAR(length(all, Is::kFascia), 2 * 0.030, 1e-9);
  EXPECT_EQ(count(all, Is::kTendon), 0u);
  const auto top = [&] {
    double high = 0;
    for (const BenchRod& rod : rods(state))
      if (rod.is == Is::kTendon) high = std::max({high, rod.a_W.z(), rod.b_W.z()});
    return high;
  };
  state.hands[1].lifts = 2;
  state.hands[1].front_m = 0.008;
  state.hands[1].from_W = found_at_W(plan, 1);
  EXPECT_NEAR(top(), 0.008, 1e-9);
  state.hands[1].lifts = 0;
  EXPECT_EQ(top(), 0);
  state.tendons[1].found = true;
  EXPECT_NEAR(top(), 0.004, 1e-9);
}

TEST_F(BenchRods, ABandThatIsCutHasAGapAndWhatIsFreedLiesOpen) {
  GraftBenchState state = fresh();
  state.tendons[0].bands_cut = 0b10;
  state.tendons[0].front_m = 0.100;
  const auto all = rods(state);
  EXPECT_EQ(count(all, Is::kBand), 4u);
  EXPECT_NEAR(length(all, Is::kBand), 3 * 0.010 - 0.004, 1e-9);
  EXPECT_NEAR(length(all, Is::kTendon), 0.100, 1e-9);
  EXPECT_NEAR(length(all, Is::kUnderSkin), 0.180 + 0.260, 1e-9);
}

TEST_F(BenchRods, AStrippedTendonLiesOnTheTableInItsWholeLength) {
  GraftBenchState state = fresh();
  state.tendons[1].stripped = true;
  const auto all = rods(state);
  EXPECT_NEAR(length(all, Is::kTendon), harvested(plan, state, 1)->length_m, 0.001);
  EXPECT_NEAR(length(all, Is::kMuscle), 0.030, 1e-6);
  for (const BenchRod& rod : all) {
    if (rod.is != Is::kTendon) continue;
    EXPECT_NEAR(rod.a_W.z() - rod.radius_m, -0.016, 1e-9);
    EXPECT_LT(rod.a_W.y(), -0.094);  // away from the other tendon
    EXPECT_GT(rod.a_W.y(), -0.150);
    EXPECT_LT(rod.a_W.x(), 0.100);
  }
  // Each rod goes on where the last one ends.
  const BenchRod* last = nullptr;
  for (const BenchRod& rod : all) {
    if (rod.is != Is::kTendon) continue;
    if (last) {
      EXPECT_LT((rod.a_W - last->b_W).norm(), 1e-9);
    }
    last = &rod;
  }
}

TEST_F(BenchRods, OneThatWasCutOffLeavesItsRestInTheThigh) {
  GraftBenchState state = fresh();
  state.tendons[0].stripped = state.tendons[0].amputated = true;
  const auto all = rods(state);
  EXPECT_NEAR(length(all, Is::kTendon), 0.060, 0.001);
  EXPECT_NEAR(length(all, Is::kUnderSkin), 0.220 + 0.260, 1e-9);
}

TEST_F(BenchRods, MuscleGoesAsItIsScrapedAndThreadComesAsItIsStitched) {
  GraftBenchState state = fresh();
  state.tendons[0].stripped = true;
  const auto radius = [&] {
    double most = 0;
    for (const BenchRod& rod : rods(state))
      if (rod.is == Is::kMuscle) most = std::max(most, rod.radius_m);
    return most;
  };
  const double whole = radius();
  state.tendons[0].scraped_m = 0.5 * kScrapedClean_m;
  EXPECT_LT(radius(), whole);
  state.tendons[0].scraped_m = kScrapedClean_m;
  EXPECT_EQ(radius(), 0);
  EXPECT_EQ(count(rods(state), Is::kThread), 0u);
  state.tendons[0].stitches = 0b1011;
  EXPECT_EQ(count(rods(state), Is::kThread), 3u + 2u);
}

TEST_F(BenchRods, AFoldedGraftHasItsStrandsAndIsAsThickAsItMeasures) {
  for (const auto& [st, gr] : {std::pair{2u, 2u}, {3u, 2u}, {1u, 0u}}) {
    GraftBenchState state = testing::folded_bench(st, gr);
    const auto graft = graft_on(plan, state);
    ASSERT_TRUE(graft);
    std::size_t strands = 0;
    double area = 0, farthest = 0;
    for (const BenchRod& rod : rods(state)) {
      if (rod.is != Is::kTendon || (rod.b_W - rod.a_W).norm() < 0.9 * graft->length_m) continue;
      ++strands;
      area += rod.radius_m * rod.radius_m;
      const Vec3 off = rod.a_W - plan.graft_from_W;
      farthest = std::max(farthest, std::hypot(off.y(), off.z()) + rod.radius_m);
    }
    EXPECT_EQ(strands, graft->strands);
    EXPECT_NEAR(area, 0.9 * 0.25 * graft->diameter_m * graft->diameter_m, 1e-9);
    EXPECT_LE(farthest, 0.5 * graft->diameter_m + 1e-9);
  }
}

TEST_F(BenchRods, TheButtonHangsOnItsLoopAndAGraftInTheKneeIsGone) {
  GraftBenchState state = testing::folded_bench(2, 2);
  EXPECT_EQ(count(rods(state), Is::kButton), 0u);
  state.loop_m = 0.020;
  const auto all = rods(state);
  EXPECT_EQ(count(all, Is::kButton), 1u);
  EXPECT_EQ(count(all, Is::kLoop), 2u);
  for (const BenchRod& rod : all)
    if (rod.is == Is::kButton) {
      EXPECT_NEAR(rod.a_W.x(), -0.016 - 0.020, 1e-9);
    }
  bones.placing.on = true;
  bones.placing.phase = PlacingPhase::kThreadInside;
  EXPECT_FALSE(rods(state).empty());
  bones.placing.phase = PlacingPhase::kThreadOut;
  EXPECT_TRUE(rods(state).empty());
}

}  // namespace
}  // namespace osteon
