#include "exercises/water_watch.h"

#include <gtest/gtest.h>

#include <memory>

namespace osteon {
namespace {

constexpr double kTick_s = 0.001;

// A tray of a scope, a shaver that sucks, and a probe; physics steps every other tick.
struct WatchedWater {
  WatchedWater()
      : water(knee_fluid(), tray(), 2 * kTick_s), watch(knee_fluid(), {1, 0, 0}, kTick_s) {
    bones.water = water.begin();
  }
  static std::vector<std::shared_ptr<const Tool>> tray() {
    std::vector<std::shared_ptr<const Tool>> out;
    for (const ToolUse use : {ToolUse{}, ToolUse{false, true, false, true}, ToolUse{}}) {
      auto tool = std::make_shared<Tool>();
      tool->use = use;
      out.push_back(std::move(tool));
    }
    return out;
  }
  // Both hands hold these for a time.
  void hold(double seconds, std::uint32_t left, std::uint32_t right, double power) {
    for (int n = 0; n < static_cast<int>(seconds / kTick_s + 0.5); ++n) {
      ++tick;
      ToolState a, b;
      a.tick = b.tick = tick;
      a.instrument = left;
      b.instrument = right;
      b.power = power;
      b.portal = 0;
      const ToolState* tools[] = {&a, &b};
      if (tick % 2 == 0) {
        const bool looks = ++bones.step % JointWater::kLookEvery == 0;
        water.step(tools, bones, {}, looks ? &gone : nullptr, bones.water);
      }
      watch.add(tools, bones, events);
    }
  }
  JointWater water;
  WaterWatch watch;
  BoneSnapshot bones;
  GoneBone gone;
  std::uint64_t tick = 0;
  std::vector<Event> events;
};

TEST(WaterWatch, ADryCaseTellsNothing) {
  WatchedWater dry;
  dry.bones.water = {};
  ToolState scope;
  scope.tick = 100;
  const ToolState* tools[] = {&scope};
  dry.watch.add(tools, dry.bones, dry.events);
  EXPECT_TRUE(dry.events.empty());
}

TEST(WaterWatch, NobodyWhoLooksMeansNoTime) {
  WatchedWater clear;
  clear.hold(2, 2, 1, 0);
  EXPECT_TRUE(clear.events.empty());
  EXPECT_EQ(clear.watch.sight().scope_s, 0);
  EXPECT_EQ(clear.watch.sight().percent(), 0);
}

TEST(WaterWatch, ClearWaterObscuresNothing) {
  WatchedWater clear;
  clear.hold(5, 0, 2, 0);
  EXPECT_NEAR(clear.watch.sight().scope_s, 5, 1e-9);
  EXPECT_EQ(clear.watch.sight().obscured_s, 0);
  ASSERT_EQ(clear.events.size(), 50u);
  for (const Event& event : clear.events) {
    EXPECT_EQ(event.kind, kWaterLooked);
    EXPECT_EQ(event.hand, 0);
    EXPECT_EQ(event.values[0], 0);
    EXPECT_GT(event.values[2], 30);
  }
}

TEST(WaterWatch, DebrisObscuresUntilItIsFlushedOutAndSuctionIsQuicker) {
  double obscured_s[2];
  for (const bool sucked : {false, true}) {
    WatchedWater cut;
    cut.hold(1, 0, 2, 0);
    for (int i = 0; i < 20; ++i) {  // 3 cm3 in 2 s
      cut.gone.all_m3 += 1.5e-7;
      cut.hold(0.1, 0, 2, 0);
    }
    cut.hold(120, 0, 1, sucked ? 0.5 : 0);
    const ObscuredSight& sight = cut.watch.sight();
    ASSERT_EQ(sight.stretches.size(), 1u);
    EXPECT_EQ(sight.stretches[0].cause, SightLost::kDebris);
    EXPECT_GT(sight.stretches[0].from_s, 1);
    EXPECT_LT(sight.stretches[0].to_s, 120);
    EXPECT_NEAR(sight.stretches[0].to_s - sight.stretches[0].from_s, sight.obscured_s, 1e-9);
    EXPECT_NEAR(sight.percent(), 100 * sight.obscured_s / 123, 1e-6);
    obscured_s[sucked] = sight.obscured_s;
  }
  EXPECT_GT(obscured_s[0], obscured_s[1] + 1);
}

// A strong sucker empties the joint faster than the pump fills it.
TEST(WaterWatch, SuctionWithoutEndLosesThePressure) {
  WatchedWater sucked;
  sucked.hold(20, 0, 1, 1);
  const ObscuredSight& sight = sucked.watch.sight();
  ASSERT_EQ(sight.stretches.size(), 1u);
  EXPECT_EQ(sight.stretches[0].cause, SightLost::kPressure);
  EXPECT_LT(sucked.events.back().values[2], 30);
}

// While the scope is out of the hand nothing counts, and a stretch ends there.
TEST(WaterWatch, AStretchEndsWithTheLook) {
  WatchedWater sucked;
  sucked.hold(10, 0, 1, 1);
  sucked.hold(5, 2, 1, 1);
  sucked.hold(5, 0, 1, 1);
  EXPECT_EQ(sucked.watch.sight().stretches.size(), 2u);
  EXPECT_NEAR(sucked.watch.sight().scope_s, 15, 1e-9);
}

// The joint may be empty meanwhile: nobody looks into it.
TEST(WaterWatch, WhereThereArePortalsAScopeLooksFromInsideOneAlone) {
  WaterWatch watch(knee_fluid(), {1}, kTick_s, true);
  BoneSnapshot bones;
  bones.water.on = true;
  ToolState scope;
  const ToolState* tools[] = {&scope};
  std::vector<Event> events;
  for (std::uint64_t tick = 1; tick <= 2000; ++tick) {
    scope.tick = tick;
    scope.portal = tick > 1000 ? 0 : kNoPortal;
    watch.add(tools, bones, events);
    EXPECT_EQ(watch.is_obscured_now(), tick > 1000 && tick >= 1100) << tick;
  }
  EXPECT_NEAR(watch.sight().scope_s, 1, 1e-9);
  EXPECT_NEAR(watch.sight().obscured_s, 1, 1e-9);
}

}  // namespace
}  // namespace osteon
