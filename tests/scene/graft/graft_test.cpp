#include "osteon/scene/graft.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

namespace osteon {
namespace {

// Against what was published of many people, not against the code's own constants.
TEST(Graft, TendonsOfManyPatientsSpreadAsPublished) {
  constexpr int kPatients = 4000;
  double st = 0, st2 = 0, gr = 0;
  int thin = 0;
  for (std::uint64_t seed = 0; seed < kPatients; ++seed) {
    const auto tendons = tendons_of(1.75, seed);
    ASSERT_TRUE(tendons);
    st += (*tendons)[0].length_m;
    st2 += (*tendons)[0].length_m * (*tendons)[0].length_m;
    gr += (*tendons)[1].length_m;
    const std::array<std::optional<HarvestedTendon>, 2> out{strip((*tendons)[0], ~0u),
                                                            strip((*tendons)[1], ~0u)};
    const std::array<std::uint32_t, 2> folds{2, 2};
    const auto graft = fold_graft(out, folds);
    ASSERT_TRUE(graft);
    thin += graft->sized_m < 0.00801 ? 1 : 0;
    for (const TendonMeasures& t : *tendons) {
      ASSERT_LE(t.bands, 3u);
      for (std::uint32_t b = 0; b < t.bands; ++b) {
        ASSERT_GT(t.bands_m[b], b > 0 ? t.bands_m[b - 1] : 0.03);
        ASSERT_LE(t.bands_m[b], 0.100);
      }
    }
    ASSERT_GE((*tendons)[0].bands, 1u);
  }
  const double mean = st / kPatients;
  EXPECT_NEAR(mean, 0.289, 0.002);
  EXPECT_NEAR(std::sqrt(st2 / kPatients - mean * mean), 0.031, 0.002);
  EXPECT_NEAR(gr / kPatients, 0.277, 0.002);
  EXPECT_NEAR(thin / double(kPatients), 0.55, 0.04);
}

TEST(Graft, TendonsAreThoseOfASeedAndTallerPatientsHaveMore) {
  const auto a = tendons_of(1.75, 7), b = tendons_of(1.75, 7), tall = tendons_of(1.95, 7);
  ASSERT_TRUE(a && b && tall);
  EXPECT_EQ((*a)[0].length_m, (*b)[0].length_m);
  EXPECT_GT((*tall)[0].length_m, (*a)[0].length_m);
  EXPECT_GT((*tall)[1].area_m2, (*a)[1].area_m2);
  EXPECT_NE((*a)[0].length_m, (*tendons_of(1.75, 8))[0].length_m);
  EXPECT_FALSE(tendons_of(0.5, 1));
  EXPECT_FALSE(tendons_of(std::numeric_limits<double>::quiet_NaN(), 1));
}

TEST(Graft, AnUncutBandCutsTheTendonOffThere) {
  const TendonMeasures tendon{0.29, 13e-6, 2, {0.06, 0.09}};
  EXPECT_EQ(strip(tendon, 0b11).length_m, 0.29);
  EXPECT_FALSE(strip(tendon, 0b11).amputated);
  EXPECT_EQ(strip(tendon, 0b01).length_m, 0.09);
  EXPECT_TRUE(strip(tendon, 0b01).amputated);
  EXPECT_EQ(strip(tendon, 0b10).length_m, 0.06);
}

// Four strands of circles of 4 mm^2 each, nine tenths of a circle.
TEST(Graft, IsAsThickAsItsStrandsAndAsLongAsTheShortest) {
  const std::array<std::optional<HarvestedTendon>, 2> out{HarvestedTendon{0.29, 14e-6, false},
                                                          HarvestedTendon{0.25, 8e-6, false}};
  const std::array<std::uint32_t, 2> folds{2, 2}, more{3, 2}, one{4, 0}, none{0, 0}, many{5, 2};
  const auto graft = fold_graft(out, folds);
  ASSERT_TRUE(graft);
  EXPECT_NEAR(graft->length_m, 0.120, 1e-12);
  EXPECT_NEAR(0.9 * 0.25 * std::numbers::pi * graft->diameter_m * graft->diameter_m, 44e-6, 1e-12);
  EXPECT_EQ(graft->strands, 4u);
  EXPECT_NEAR(graft->sized_m, 0.008, 1e-9);
  EXPECT_NEAR(fold_graft(out, more)->length_m, 0.28 / 3, 1e-12);
  EXPECT_GT(fold_graft(out, more)->diameter_m, graft->diameter_m);
  EXPECT_EQ(fold_graft(out, one)->strands, 4u);
  EXPECT_FALSE(fold_graft(out, none));
  EXPECT_FALSE(fold_graft(out, many));
  const std::array<std::optional<HarvestedTendon>, 2> lost{HarvestedTendon{0.06, 14e-6, true},
                                                           std::nullopt};
  EXPECT_NEAR(fold_graft(lost, folds)->length_m, 0.025, 1e-12);
  EXPECT_EQ(fold_graft(lost, folds)->strands, 2u);
}

TEST(Graft, IsSizedByTheSmallestTubeThatItPasses) {
  EXPECT_NEAR(sizer_for(0.0080), 0.0080, 1e-9);
  EXPECT_NEAR(sizer_for(0.00801), 0.0085, 1e-9);
  EXPECT_NEAR(sizer_for(0.0040), 0.0060, 1e-9);
  EXPECT_NEAR(sizer_for(0.0120), 0.0120, 1e-9);
  EXPECT_EQ(sizer_for(0.0121), 0);
}

// The technique's own example: channel 40, graft 20, loop 20, socket 26 mm.
TEST(Graft, TheLoopLeavesRoomForTheButtonToTurn) {
  const LoopFit good = fit_loop(0.040, 0.026, 0.020);
  EXPECT_NEAR(good.in_socket_m, 0.020, 1e-12);
  EXPECT_TRUE(good.flips);
  EXPECT_FALSE(fit_loop(0.040, 0.026, 0.015).flips);
  EXPECT_FALSE(fit_loop(0.030, 0.026, 0.035).flips);
  EXPECT_NEAR(loop_for(0.040, 0.026), 0.020, 1e-12);
  EXPECT_NEAR(loop_for(0.041, 0.026), 0.025, 1e-12);
  EXPECT_EQ(loop_for(0.040, 0.001), 0);
}

TEST(Graft, CreepGoesWithTimeUnderTensionAndWithCycles) {
  EXPECT_EQ(creep_left(0), 1);
  EXPECT_LT(creep_left(600), 0.1);
  EXPECT_LT(creep_left(300, 25), creep_left(300));
}

}  // namespace
}  // namespace osteon
