#include "osteon/physics/joint_water.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <memory>
#include <numbers>

namespace osteon {
namespace {

constexpr double kWaterStep_s = 0.002;
constexpr std::uint32_t kProbe = 0, kShaver = 1, kAblator = 2;

std::vector<std::shared_ptr<const Tool>> water_tray() {
  std::vector<std::shared_ptr<const Tool>> tray;
  for (const ToolUse use :
       {ToolUse{}, ToolUse{false, true, false, true}, ToolUse{false, false, true, false}}) {
    auto tool = std::make_shared<Tool>();
    tool->use = use;
    tray.push_back(std::move(tool));
  }
  return tray;
}

SoftOpening opening_at(const Vec3& p_W, double area_m2, std::uint32_t soft = 0) {
  return {soft, BoneId{0}, p_W, area_m2};
}

// One bone at the World's origin, one hand, and bone that is gone as the test says.
struct FlowingWater {
  explicit FlowingWater(const FluidJoint& joint = knee_fluid())
      : water(joint, water_tray(), kWaterStep_s), state(water.begin()) {
    bones.count = 1;
    bones.bones[0].X_WB = Pose{};
    hand.tick = 1;
  }

  void flow(double seconds) {
    for (long n = std::lround(seconds / kWaterStep_s); n > 0; --n) step({});
  }
  void step(std::span<const SoftOpening> openings) {
    const ToolState* const tools[] = {&hand};
    const bool looks = ++bones.step % JointWater::kLookEvery == 0;
    water.step(tools, bones, openings, looks ? &gone : nullptr, state);
  }
  double pressure_mmhg() const { return state.pressure_pa / kPa_per_mmHg; }
  double turbid() const { return turbidity(water.joint(), fluid_of(state)); }

  JointWater water;
  BoneSnapshot bones;
  ToolState hand;
  GoneBone gone;
  WaterState state;
};

TEST(JointWater, BeginsDistendedAndClearAndStaysSo) {
  FlowingWater knee;
  const double rest_pa = knee.state.pressure_pa;
  // What flows in flows out: 8 (60 - p) = (2 + 0.3) p, mmHg.
  EXPECT_NEAR(knee.pressure_mmhg(), 8 * 60 / 10.3, 0.1);
  knee.flow(20);
  EXPECT_NEAR(knee.state.pressure_pa, rest_pa, 1);
  EXPECT_EQ(knee.turbid(), 0);
}

TEST(JointWater, CorticalBoneGivesPaleSlurryThatTheFlowTakesAway) {
  FlowingWater knee;
  knee.gone.all_m3 = 2e-7;
  knee.flow(1);
  EXPECT_GT(knee.turbid(), 0.05);
  EXPECT_EQ(knee.state.blood, 0) << "hard bone does not bleed";
  // All of it came in, less than 2 % has left since.
  EXPECT_NEAR(knee.state.debris * knee_fluid().room_m3, 2e-7, 2e-8);
  const double share = knee.state.debris;
  knee.flow(30);
  const double flow_ml_min = 8 * (60 - knee.pressure_mmhg());
  const double room_ml = 1e6 * knee_fluid().room_m3;
  EXPECT_NEAR(knee.state.debris / share, std::exp(-flow_ml_min / room_ml * 0.5), 0.01);
}

TEST(JointWater, OpenedSoftBoneBleedsByItsWallAndLessUnderPressure) {
  const auto after_five_minutes = [](double pump_mmhg) {
    FlowingWater knee;
    set_pump(kPa_per_mmHg * pump_mmhg, knee.state);
    knee.gone = {1.5e-6, 1.5e-6};
    knee.flow(300);
    return knee;
  };
  const FlowingWater usual = after_five_minutes(60), high = after_five_minutes(90);
  // 0.05 ml/min from each cm2 of a ball of 1.5 ml.
  const double wall_cm2 = std::cbrt(36 * std::numbers::pi * 1.5 * 1.5);
  EXPECT_NEAR(usual.state.bleeding_m3_s / kM3_s_per_ml_min, 0.05 * wall_cm2, 1e-3 * wall_cm2);
  EXPECT_GT(usual.turbid(), 0.02);
  EXPECT_LT(high.turbid(), 0.5 * usual.turbid());
}

TEST(JointWater, AWoundBleedsByItsAreaUntilThePressureStopsIt) {
  FlowingWater knee;
  const SoftOpening cut = opening_at(Vec3(0.01, 0, 0), 1e-4);
  knee.step({&cut, 1});
  const Wound& wound = knee.state.wounds[0];
  EXPECT_EQ(wound.soft, 0u);
  EXPECT_DOUBLE_EQ(wound.open_m2, 1e-4);
  // 0.3 ml/min from a cm2 into a joint without pressure, none against that of its vessels.
  EXPECT_NEAR(wound_flow(knee_fluid(), wound, 0) / kM3_s_per_ml_min, 0.3, 1e-3);
  EXPECT_NEAR(wound_flow(knee_fluid(), wound, 0.5 * knee_fluid().vessel_pa) / kM3_s_per_ml_min,
              0.15, 1e-3);
  EXPECT_EQ(wound_flow(knee_fluid(), wound, knee_fluid().vessel_pa), 0);
  EXPECT_NEAR(knee.state.bleeding_m3_s / kM3_s_per_ml_min, 0.3, 1e-3);
  knee.flow(60);
  EXPECT_GT(knee.state.blood, 0);
}

TEST(JointWater, WhatIsOpenedNearIsOneWoundAndTheListIsBounded) {
  FlowingWater knee;
  const SoftOpening near[] = {opening_at(Vec3(0, 0, 0), 1e-6), opening_at(Vec3(0.002, 0, 0), 2e-6),
                              opening_at(Vec3(0, 0, 0), 1e-6, 1)};
  knee.step(near);
  EXPECT_DOUBLE_EQ(knee.state.wounds[0].open_m2, 3e-6);
  EXPECT_EQ(knee.state.wounds[1].soft, 1u) << "another part is another wound";
  double all_m2 = 4e-6;
  for (int n = 1; n <= 40; ++n, all_m2 += 1e-6) {
    const SoftOpening far = opening_at(Vec3(0.01 * n, 0, 0), 1e-6);
    knee.step({&far, 1});
  }
  double open_m2 = 0;
  for (const Wound& wound : knee.state.wounds) open_m2 += wound.open_m2;
  EXPECT_NEAR(open_m2, all_m2, 1e-12) << "where no place is free the nearest wound grows";
}

TEST(JointWater, AWoundMovesWithItsBone) {
  FlowingWater knee;
  knee.bones.bones[0].X_WB.p = Vec3(0.1, 0.2, 0.3);
  const SoftOpening cut = opening_at(Vec3(0.11, 0.2, 0.3), 1e-6);
  knee.step({&cut, 1});
  EXPECT_LT((knee.state.wounds[0].p_B - Vec3(0.01, 0, 0)).norm(), 1e-12);
}

TEST(JointWater, HeatNearAWoundSealsIt) {
  FlowingWater knee;
  const SoftOpening cut = opening_at(Vec3(0.003, 0, 0), 1e-5);
  knee.step({&cut, 1});
  knee.hand.instrument = kAblator;
  knee.hand.power = 0;
  knee.flow(1);
  EXPECT_DOUBLE_EQ(knee.state.wounds[0].open_m2, 1e-5) << "without power";
  knee.hand.power = 1;
  knee.flow(1);
  EXPECT_NEAR(knee.state.wounds[0].open_m2, 1e-5 * std::exp(-1.0), 1e-9);
  knee.hand.X_WP.p = Vec3(0.1, 0, 0);
  knee.flow(1);
  EXPECT_NEAR(knee.state.wounds[0].open_m2, 1e-5 * std::exp(-1.0), 1e-9) << "too far";
  knee.hand.X_WP.p = Vec3::Zero();
  knee.flow(6);
  EXPECT_EQ(knee.state.wounds[0], Wound{});
  EXPECT_EQ(knee.state.bleeding_m3_s, 0);
}

TEST(JointWater, SuctionClearsAndWithoutEndLosesThePressure) {
  FlowingWater rest, sucked;
  rest.gone.all_m3 = sucked.gone.all_m3 = 5e-7;
  sucked.hand.instrument = kShaver;
  sucked.hand.power = 0.3;
  rest.flow(30);
  sucked.flow(30);
  EXPECT_DOUBLE_EQ(sucked.state.suction, 0.3);
  EXPECT_LT(sucked.turbid(), rest.turbid());
  sucked.hand.power = 1;
  sucked.flow(30);
  EXPECT_LT(sucked.pressure_mmhg(), 30);
  sucked.hand.instrument = kProbe;  // it has power, and does nothing with it
  sucked.flow(60);
  EXPECT_EQ(sucked.state.suction, 0);
  EXPECT_GT(sucked.pressure_mmhg(), 40);
}

TEST(JointWater, ADrillFromOutsideLeavesAFifthOfItsChipsInside) {
  double debris[2];
  for (const bool inside : {false, true}) {
    FlowingWater knee;
    knee.hand.instrument = kShaver;
    knee.hand.power = 1e-9;  // it turns, and sucks next to nothing
    knee.hand.portal = inside ? 1 : kNoPortal;
    knee.gone.all_m3 = 1e-7;
    knee.flow(0.3);
    debris[inside] = knee.state.debris;
  }
  EXPECT_NEAR(debris[0] / debris[1], 0.2, 0.001);
}

TEST(JointWater, ARestorePointBringsBackTheWaterButNotThePump) {
  FlowingWater knee;
  const SoftOpening cut = opening_at(Vec3::Zero(), 1e-5);
  knee.step({&cut, 1});
  const WaterState kept = knee.state;
  set_pump(90 * kPa_per_mmHg, knee.state);
  set_outlet(1, knee.state);
  knee.flow(5);
  WaterState wanted = kept;
  wanted.pump_pa = 90 * kPa_per_mmHg;
  wanted.outlet_open = 1;
  EXPECT_EQ(JointWater::gone_back(kept, knee.state), wanted);
}

TEST(JointWater, NumbersThatAreNoneChangeNothing) {
  const double nan = std::nan(""), inf = std::numeric_limits<double>::infinity();
  FlowingWater knee;
  const WaterState before = knee.state;
  for (const double bad : {nan, inf, -inf, -1.0, 1e9}) {
    set_pump(bad, knee.state);
    set_outlet(bad, knee.state);
  }
  EXPECT_EQ(knee.state, before);
  knee.hand.power = nan;
  knee.hand.instrument = kAblator;
  knee.hand.X_WP.p = Vec3(nan, 0, 0);
  const SoftOpening bad[] = {opening_at(Vec3(nan, 0, 0), 1e-6),
                             opening_at(Vec3::Zero(), nan),
                             opening_at(Vec3::Zero(), -1),
                             {0, BoneId{7}, Vec3::Zero(), 1e-6}};
  for (int n = 0; n < 200; ++n) knee.step(bad);
  EXPECT_EQ(knee.state.wounds[0], Wound{});
  EXPECT_TRUE(JointWater::fits(knee.state));
  WaterState broken = knee.state;
  broken.blood = nan;
  EXPECT_FALSE(JointWater::fits(broken));
  broken = knee.state;
  broken.wounds[3] = {0, BoneId{kMaxBones}, Vec3::Zero(), 1e-6};
  EXPECT_FALSE(JointWater::fits(broken));
}

}  // namespace
}  // namespace osteon
