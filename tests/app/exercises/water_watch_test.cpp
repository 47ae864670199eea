#include "exercises/water_watch.h"

#include <gtest/gtest.h>

namespace osteon {
namespace {

constexpr double kTick_s = 0.001;

// A tray of a scope, a shaver that sucks, and a probe; bone goes as `gone` says.
struct WatchedWater {
  explicit WatchedWater(std::function<ByTissue()> gone = {})
      : watch(knee_fluid(), {1, 0, 0}, WaterTools{{false, true, false}, {false, true, false}},
              std::move(gone), kTick_s) {}
  // Both hands hold these for a time.
  void hold(double seconds, std::uint32_t left, std::uint32_t right, double power) {
    for (int n = 0; n < static_cast<int>(seconds / kTick_s + 0.5); ++n) {
      ++tick;
      ToolState a, b;
      a.tick = b.tick = tick;
      a.instrument = left;
      b.instrument = right;
      b.power = power;
      const ToolState* tools[] = {&a, &b};
      watch.add(tools, events);
    }
  }
  WaterWatch watch;
  std::uint64_t tick = 0;
  std::vector<Event> events;
};

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
    double gone_m3 = 0;
    WatchedWater cut([&] {
      ByTissue gone{};
      gone[static_cast<std::size_t>(BoneTissue::kCortical)] = gone_m3;
      return gone;
    });
    cut.hold(1, 0, 2, 0);
    for (int i = 0; i < 20; ++i) {  // 3 cm3 in 2 s
      gone_m3 += 1.5e-7;
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

}  // namespace
}  // namespace osteon
