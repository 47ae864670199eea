#include "water/water_drift.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "osteon/physics/joint_water.h"

namespace osteon {
namespace {

constexpr double kRoofAt_m = 0.012;  // of z

std::optional<double> flat_roof(const Vec3& p_W, double most_m) {
  const double up = kRoofAt_m - p_W.z();
  return up > 0 && up < most_m ? std::optional(up) : std::nullopt;
}
std::optional<double> no_roof(const Vec3&, double) { return std::nullopt; }

/// A scope, an ablator that does not suck, a burr, a shaver and a punch.
std::vector<std::shared_ptr<const Tool>> tray_of_five() {
  std::vector<std::shared_ptr<const Tool>> tray;
  for (const ToolUse& use :
       {ToolUse{}, ToolUse{false, true, true, false}, ToolUse{false, true, false, false},
        ToolUse{false, true, false, true}, ToolUse{true, true, false, false}}) {
    auto tool = std::make_shared<Tool>();
    tool->use = use;
    tray.push_back(std::move(tool));
  }
  return tray;
}
enum Held : std::uint32_t { kScope, kAblator, kBurr, kShaver, kPunch };

struct Scene {
  Scene() {
    bones.water.on = true;
    bones.water.pump_pa = FluidDrive().pump_pa;
    bones.water.outlet_open = FluidDrive().outlet_open;
    bones.water.pressure_pa = 45 * kPa_per_mmHg;
    for (ToolState& tool : tools) tool.tick = 1;
    tools[1].X_WP.p = Vec3(0.010, 0, 0);
  }
  void hold(Held held, double power, double force_n = 0) {
    tools[1].instrument = held;
    tools[1].power = power;
    tools[1].force_W = Vec3(0, 0, force_n);
  }
  /// For so long, with a picture each `each_s`.
  void run(double seconds, const RoofAbove& roof = flat_roof, double each_s = 1.0 / 32) {
    const double until_s = now_s + seconds;
    for (; now_s <= until_s; now_s += each_s) drift.go_to(now_s, tools, bones, Vec3::Zero(), roof);
  }
  std::size_t count(WaterBit::Is is) const {
    std::size_t n = 0;
    for (const WaterBit& bit : drift.bits()) n += bit.is == is;
    return n;
  }
  std::size_t bubbles() const { return count(WaterBit::Is::kBubble); }
  std::size_t flakes() const { return count(WaterBit::Is::kFlake); }

  BoneSnapshot bones;
  std::vector<ToolState> tools{2};
  WaterDrift drift{knee_fluid(), tray_of_five()};
  double now_s = 0;
};

TEST(WaterDrift, NothingDriftsWhereNothingIsDoneOrThereIsNoWater) {
  Scene scene;
  scene.run(2);
  EXPECT_TRUE(scene.drift.bits().empty());
  scene.hold(kAblator, 1);
  scene.bones.water.on = false;
  scene.run(2);
  EXPECT_TRUE(scene.drift.bits().empty());
  scene.drift.go_to(std::nan(""), scene.tools, scene.bones, std::nullopt, flat_roof);
  scene.bones.water.on = true;
  scene.tools[1].X_WP.p.x() = std::numeric_limits<double>::quiet_NaN();
  scene.run(1);
  scene.tools[1] = ToolState{};
  scene.tools[1].tick = 1;
  scene.hold(static_cast<Held>(77), 1);
  scene.run(1);
  EXPECT_TRUE(scene.drift.bits().empty());
}

TEST(WaterDrift, BubblesOfAnAblatorRiseToTheRoofAndClingThere) {
  Scene scene;
  scene.hold(kAblator, 1);
  scene.run(1);
  EXPECT_GT(scene.bubbles(), 5u);
  scene.hold(kAblator, 0);
  scene.run(3);  // the smallest rises 14 mm in one
  ASSERT_GT(scene.bubbles(), 2u);
  for (const WaterBit& bit : scene.drift.bits()) {
    EXPECT_NEAR(bit.p_W.z() + bit.radius_m, kRoofAt_m, 1e-9);
    EXPECT_LT((bit.p_W - Vec3(0.010, 0, kRoofAt_m)).norm(), 0.012);
  }
  // What the water is exchanged by carries them off in the end: 0.02 of it a second.
  const std::size_t then = scene.bubbles();
  scene.run(400);
  EXPECT_LT(scene.bubbles(), then);
}

TEST(WaterDrift, NoBubbleIsMadeWhereNoJointClosesAbove) {
  Scene scene;
  scene.hold(kAblator, 1);
  scene.run(1, no_roof);
  EXPECT_EQ(scene.bubbles(), 0u);
}

TEST(WaterDrift, AirComesInBelowTheAirsPressureAndWithAPumpThatIsRaised) {
  Scene low;
  low.bones.water.pressure_pa = -2 * kPa_per_mmHg;
  low.run(1);
  EXPECT_GT(low.bubbles(), 0u);
  Scene raised;
  raised.run(0.5);
  raised.bones.water.pump_pa += 30 * kPa_per_mmHg;
  raised.run(2);
  EXPECT_GT(raised.bubbles(), 0u);
  Scene lowered;
  lowered.run(0.5);
  lowered.bones.water.pump_pa -= 30 * kPa_per_mmHg;
  lowered.run(2);
  EXPECT_EQ(lowered.bubbles(), 0u);
}

TEST(WaterDrift, ChipsComeWithSlurryShredsWithWhatIsPressedAndBites) {
  Scene burr;
  burr.hold(kBurr, 1);
  burr.run(1);
  EXPECT_EQ(burr.flakes(), 0u) << "it runs in water";
  burr.bones.water.debris_m3_s = 2e-9;
  burr.run(1);
  EXPECT_GT(burr.flakes(), 4u);
  Scene pressed;
  pressed.hold(kBurr, 1, 1.0);
  pressed.run(2);
  EXPECT_GT(pressed.flakes(), 3u);
  Scene punch;
  punch.hold(kPunch, 0, 1.0);
  punch.tools[1].jaw = 1;
  punch.run(0.5);
  EXPECT_EQ(punch.flakes(), 0u);
  punch.tools[1].jaw = 0;
  punch.run(0.5);
  EXPECT_EQ(punch.flakes(), 2u) << "one bite";
}

TEST(WaterDrift, SuctionTakesFlakesThatAreNearAndDrawsThoseFartherOff) {
  Scene scene;
  scene.hold(kBurr, 1);
  scene.bones.water.debris_m3_s = 2e-9;
  scene.run(1);
  const std::size_t before = scene.flakes();
  ASSERT_GT(before, 4u);
  scene.bones.water.debris_m3_s = 0;
  scene.hold(kShaver, 1);
  scene.bones.water.suction = 1;
  scene.run(3);
  EXPECT_LT(scene.flakes(), before / 2);
}

TEST(WaterDrift, ThereIsRoomForSoManyOnly) {
  Scene scene;
  scene.hold(kAblator, 1, 1.0);
  scene.bones.water.debris_m3_s = 1e-6;
  scene.run(30);
  EXPECT_LE(scene.drift.bits().size(), kMostWaterBits);
  EXPECT_GT(scene.flakes(), 30u);
}

TEST(WaterDrift, TheSameMomentsGiveTheSameBitsAndALeapLeavesNone) {
  const auto played = [](double each_s) {
    Scene scene;
    scene.hold(kAblator, 1, 1.0);
    scene.run(2, flat_roof, each_s);
    return scene.drift.bits();
  };
  EXPECT_FALSE(played(1.0 / 32).empty());
  EXPECT_EQ(played(1.0 / 32), played(1.0 / 32));
  // While nothing changes, how often it is looked at does not matter.
  EXPECT_EQ(played(1.0 / 32), played(1.0 / 128));
  Scene scene;
  scene.hold(kAblator, 1);
  scene.run(1);
  scene.now_s += 5;
  scene.run(0.01);
  EXPECT_TRUE(scene.drift.bits().empty());
  scene.run(1);
  EXPECT_FALSE(scene.drift.bits().empty());
  scene.now_s -= 1;
  scene.run(0.01);
  EXPECT_TRUE(scene.drift.bits().empty()) << "back in time";
}

TEST(WaterDrift, WhatIsStrewnForAPictureHasRisenAndIsTheSameEachTime) {
  const auto bits = strewn_bits(10, 6, Vec3::Zero(), flat_roof);
  ASSERT_EQ(bits.size(), 16u);
  EXPECT_EQ(bits, strewn_bits(10, 6, Vec3::Zero(), flat_roof));
  for (std::size_t k = 0; k < 10; ++k)
    EXPECT_NEAR(bits[k].p_W.z() + bits[k].radius_m, kRoofAt_m, 1e-9);
  EXPECT_EQ(strewn_bits(10, 6, Vec3::Zero(), no_roof).size(), 6u);
  EXPECT_TRUE(strewn_bits(0, 0, Vec3::Zero(), flat_roof).empty());
}

}  // namespace
}  // namespace osteon
