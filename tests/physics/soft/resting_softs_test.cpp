// Bands as loose pieces meet them.
#include "soft/resting_softs.h"

#include <gtest/gtest.h>

namespace osteon {
namespace {

TEST(RestingSofts, ABandIsAsDeepAsAPointIsUnderItsSurfaceAndTellsHowNearItsMiddleThatIs) {
  SoftSetup setup;
  SoftBand band;
  band.from = band.to = BoneId{0};
  band.from_B = {-0.02, 0, 0};
  band.to_B = {0.02, 0, 0};
  band.radius_m = 0.002;
  setup.bands.push_back(band);
  SoftState state;
  BoneSnapshot bones;
  bones.count = 1;
  bones.bones[0].X_WB.p = {0, 0, 0.1};
  RestingSofts softs(setup, state, nullptr);
  softs.place(bones);
  const PiecePush push = softs.at({0.003, 0, 0.1005});
  EXPECT_NEAR(push.depth_m, 0.0015, 1e-12);
  EXPECT_NEAR(push.of_half, 0.75, 1e-9);
  EXPECT_LT((push.out_W - Vec3::UnitZ()).norm(), 1e-9);
  EXPECT_FALSE(softs.at({0.003, 0, 0.1025}).depth_m > 0);
  state.bands[0].torn = true;
  EXPECT_FALSE(softs.at({0.003, 0, 0.1005}).depth_m > 0);
}

TEST(RestingSofts, WhatASetUpLetsStopPiecesStopsThem) {
  SoftSetup setup;
  setup.bands.resize(1);
  const SoftState state;
  const RestingSofts softs(setup, state, nullptr);
  let_thin_parts_stop_pieces(setup);
  EXPECT_FALSE(softs.thin_ones_stop()) << "nothing stops them";
  let_pieces_be_stopped(setup);
  const std::uint64_t before = setup.hash;
  let_thin_parts_stop_pieces(setup);
  EXPECT_TRUE(softs.stops_carried() && softs.thin_ones_stop());
  EXPECT_NE(setup.hash, before) << "a recording knows";
}

}  // namespace
}  // namespace osteon
