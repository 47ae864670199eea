#include "water/scope_water.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace osteon {
namespace {

BoneSnapshot bones_in_water(double pressure_mmhg) {
  BoneSnapshot bones;
  bones.count = 1;
  bones.bones[0].X_WB = Pose{Vec3(0.1, 0, 0), Quat::Identity()};
  bones.water.on = true;
  bones.water.pressure_pa = kPa_per_mmHg * pressure_mmhg;
  bones.water.pump_pa = FluidDrive().pump_pa;
  bones.water.outlet_open = FluidDrive().outlet_open;
  return bones;
}

TEST(ScopeWater, WithoutWaterOrWithClearWaterNothingStandsBetween) {
  EXPECT_TRUE(scope_water(knee_fluid(), BoneSnapshot{}).clear());
  EXPECT_EQ(scope_water(knee_fluid(), bones_in_water(45)), ScopeWater());
}

TEST(ScopeWater, BloodAndDebrisTakeTheirShareOfTheLight) {
  BoneSnapshot bones = bones_in_water(45);
  bones.water.blood = 0.01;
  bones.water.debris = 0.02;
  const ScopeWater seen = scope_water(knee_fluid(), bones);
  EXPECT_NEAR(seen.taken_per_m, 6000 * 0.01 + 3000 * 0.02, 1e-9);
  EXPECT_NEAR(seen.blood, 0.5, 1e-12);
  FluidState otherwise;
  EXPECT_TRUE(scope_water(knee_fluid(), bones, &otherwise).clear());
}

TEST(ScopeWater, EachWoundThatBleedsHasAPlumeWhereItsBoneIs) {
  BoneSnapshot bones = bones_in_water(40);
  bones.water.wounds[2] = {5, BoneId{0}, Vec3(0, 0.01, 0), 1e-4};
  bones.water.wounds[4] = {6, BoneId{3}, Vec3::Zero(), 1e-4};  // of a bone that is not there
  const ScopeWater seen = scope_water(knee_fluid(), bones);
  ASSERT_EQ(seen.plume_count, 1u);
  EXPECT_FALSE(seen.clear());
  EXPECT_LT((seen.plumes[0].p_W - Vec3(0.1, 0.01, 0)).norm(), 1e-12);
  // 0.15 ml/min (0.3 at no pressure, half of the vessels' 80 mmHg) at 5 mm/s through a disc that
  // reaches 2.5 mm beyond one of half the area.
  const double radius_m = 0.0025 + std::sqrt(0.5e-4 / std::numbers::pi);
  EXPECT_NEAR(seen.plumes[0].radius_m, radius_m, 1e-12);
  const double share = 0.15 * kM3_s_per_ml_min / (std::numbers::pi * radius_m * radius_m * 0.005);
  EXPECT_NEAR(seen.plumes[0].taken_per_m, 6000 * share, 6000 * share * 0.01);
  bones.water.pressure_pa = knee_fluid().vessel_pa;
  EXPECT_TRUE(scope_water(knee_fluid(), bones).clear()) << "the pressure stops it";
}

TEST(ScopeWater, MoreWoundsThanAPictureShowsAreLeftOut) {
  BoneSnapshot bones = bones_in_water(0);
  for (Wound& wound : bones.water.wounds) wound = {0, BoneId{0}, Vec3::Zero(), 1e-4};
  EXPECT_EQ(scope_water(knee_fluid(), bones).plume_count, ScopeWater::kMostPlumes);
}

TEST(OtherPump, FillsTheJointAsItsOwnSettingsDo) {
  OtherPump low(knee_fluid(), {20 * kPa_per_mmHg, 0.5});
  WaterState session = bones_in_water(45).water;
  low.go_to(0, session);
  EXPECT_DOUBLE_EQ(low.state().pressure_pa, session.pressure_pa) << "it begins as the session is";
  for (int k = 1; k <= 600; ++k) low.go_to(0.1 * k, session);
  EXPECT_NEAR(low.state().pressure_pa / kPa_per_mmHg, 8 * 20 / 10.3, 0.1);
  session.blood = 0.01;
  low.go_to(30, session);
  EXPECT_DOUBLE_EQ(low.state().blood, 0.01) << "back in time: as the session is then";
  low.go_to(std::nan(""), session);
  low.go_to(400, session);
  EXPECT_DOUBLE_EQ(low.state().pressure_pa, session.pressure_pa) << "a leap";
}

}  // namespace
}  // namespace osteon
