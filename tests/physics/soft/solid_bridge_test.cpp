// What holds a flap: the narrowest section between a place and what the solid hangs on.
#include "soft/solid_bridge.h"

#include <gtest/gtest.h>

#include "carve/carve_fixtures.h"

namespace osteon {
namespace {

constexpr double kBridgeHalf_m = 0.006, kBridgeCell_m = 0.0003;
const Vec3 kFree(0.005, 0, 0);  // beyond the slit; the other end is held

// A cube whose end at -x is held. Balls of half a millimetre cut a slit across it at x = 0 that
// leaves |y| < half of `wide_m`, |z| < half of `high_m`.
struct Slitted {
  CarvedField field = test::value(
      CarvedField::make(test::block_field(kBridgeHalf_m, kBridgeCell_m), {}, 4096, 0.004));
  LoosePieces pieces{field};
  BridgeSearch search{field};

  Slitted(double wide_m, double high_m) {
    pieces.hang(field, [](const Vec3& p) { return p.x() < -0.005; });
    const Cutter ball = test::cutter("burr", 1);
    constexpr double kBall_m = 0.0005, kOut_m = 0.0066;
    for (double z = -kOut_m; z <= kOut_m; z += 0.0003)
      for (const double side : {-1.0, 1.0}) {
        const double to = std::abs(z) < high_m / 2 + kBall_m ? wide_m / 2 + kBall_m : 0;
        (void)field.cut(ball, {Vec3(0, side * kOut_m, z), Quat::Identity()},
                        {Vec3(0, side * to, z), Quat::Identity()});
      }
  }
  std::optional<SolidBridge> from(const Vec3& p, double most_m2 = 1e-3) {
    return search.narrowest(field, pieces, p, 0.001, most_m2);
  }
};

TEST(SolidBridge, ItsAreaIsThatOfWhatTheSlitLeaves) {
  for (const double wide : {0.0018, 0.003, 0.006})
    for (const double high : {0.0018, 0.003}) {
      Slitted solid(wide, high);
      const auto bridge = solid.from(kFree);
      ASSERT_TRUE(bridge) << wide << " " << high;
      EXPECT_NEAR(bridge->area_m2, wide * high, 0.3e-3 * (wide + high)) << wide << " " << high;
      EXPECT_NEAR(bridge->middle_B.x(), 0, 0.0007);
      EXPECT_EQ(bridge->middles_B.size(),
                static_cast<std::size_t>(bridge->area_m2 / (kBridgeCell_m * kBridgeCell_m) + 0.5));
    }
}

// Parted there, the end hangs on nothing any more.
TEST(SolidBridge, WhatItPartsComesOff) {
  Slitted solid(0.003, 0.003);
  EXPECT_TRUE(solid.pieces.find(solid.field).empty());
  const auto bridge = solid.from(kFree);
  ASSERT_TRUE(bridge);
  const Cutter rip = test::cutter("burr", 0.7);
  for (const Vec3& p : bridge->middles_B) (void)solid.field.cut(rip, {p, Quat::Identity()});
  const auto pieces = solid.pieces.find(solid.field);
  ASSERT_EQ(pieces.size(), 1u);
  EXPECT_GT(pieces[0].middle_B.x(), 0.002);
  EXPECT_FALSE(solid.from(kFree));  // nothing holds it
}

TEST(SolidBridge, WhatIsWideOrHeldOrNotThereHasNone) {
  Slitted solid(0.003, 0.003);
  EXPECT_FALSE(solid.from(kFree, 5e-6));          // it is 9 mm2
  EXPECT_FALSE(solid.from(Vec3(-0.0055, 0, 0)));  // it is held itself
  EXPECT_FALSE(solid.from(Vec3(0.5, 0, 0)));
  EXPECT_TRUE(solid.from(kFree, 12e-6));
}

}  // namespace
}  // namespace osteon
