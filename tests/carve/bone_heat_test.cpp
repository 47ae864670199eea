#include "osteon/carve/bone_heat.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "carve/carve_fixtures.h"

namespace osteon {
namespace {

using namespace test;

CarvedField block_of_bone(const Vec3& half_m, double cell_m) {
  UncutFieldOptions options;
  options.cell_m = cell_m;
  return value(CarvedField::make(value(UncutField::make(box_mesh(half_m), options)), {}, 4096));
}

// A block of 24 mm, cells of heat of 0.5 mm; nothing of its surface is near.
const CarvedField& large() {
  static const CarvedField field = block_of_bone(Vec3::Constant(0.012), 0.00025);
  return field;
}

HeatSource at(const Vec3& p_B, double joules, double radius_m = 0) {
  HeatSource source;
  source.tip_B = p_B;
  source.radius_m = radius_m;
  source.joules = joules;
  source.ball = true;
  return source;
}

// The middle of the cell that a temperature is of.
Vec3 on_cell(const BoneHeat& heat, const Vec3& p_B) {
  const HeatVolume volume = heat.volume();
  const Vec3 u = (p_B - volume.lo_B) / volume.cell_m;
  return volume.lo_B + volume.cell_m * Vec3(u.array().round());
}

TEST(BoneHeat, WhatWarmsNothingMakesNoBlocks) {
  BoneHeat heat(large(), {});
  heat.step(large(), 1, {}, 0);
  heat.add(large(), at(Vec3(1, 0, 0), 1));
  heat.add(large(), at(Vec3::Zero(), -1));
  heat.add(large(), at(Vec3::Constant(std::numeric_limits<double>::quiet_NaN()), 1));
  heat.step(large(), std::numeric_limits<double>::quiet_NaN(), {}, 0);
  EXPECT_EQ(heat.blocks(), 0u);
  EXPECT_EQ(heat.hottest_c(), 37);
  EXPECT_EQ(heat.temperature_at(Vec3::Zero()), 37);
  EXPECT_TRUE(heat.volume().cells.empty());
  EXPECT_EQ(heat.necrosis_m3(0), 0);
  EXPECT_EQ(heat.necrosis_m3(7), 0);
}

TEST(BoneHeat, APointSourceSpreadsAsItsClosedForm) {
  BoneHeat heat(large(), {});
  heat.add(large(), at(Vec3::Zero(), 1));
  EXPECT_NEAR(heat.energy_j(), 1, 1e-9);
  for (int i = 0; i < 100; ++i) heat.step(large(), 0.1, {}, 0);
  EXPECT_NEAR(heat.energy_j(), 1, 0.003);
  for (const double r_mm : {0.0, 0.8, 1.6, 2.4, 3.2, 4.0}) {
    const Vec3 place = on_cell(heat, Vec3(0, r_mm * 1e-3, 0));
    const double expected = point_source_rise({}, 1, place.norm(), 10);
    const double got = heat.temperature_at(place) - 37;
    EXPECT_NEAR(got / expected, 1, 0.1) << r_mm;
  }
}

TEST(BoneHeat, AMovingSourceAgreesWithRosenthalWithinTenPercent) {
  const CarvedField field = block_of_bone(Vec3(0.016, 0.010, 0.010), 0.00025);
  BoneHeat heat(field, {});
  const double speed = 0.1e-3, watts = 0.5, dt = 0.1;
  Vec3 source(-0.010, 0, 0);
  for (int i = 0; i < 1400; ++i) {
    heat.add(field, at(source, watts * dt));
    heat.step(field, dt, {}, 0);
    source.x() += speed * dt;
  }
  const Vec3 places_mm[] = {{-3.2, 0, 0}, {3.2, 0, 0},  {-3.2, 3.2, 0},
                            {0, 3.2, 0},  {-4, 0, 3.2}, {0, 2.4, -2.4}};
  for (const Vec3& mm : places_mm) {
    const Vec3 place = on_cell(heat, source + 1e-3 * mm);
    const double expected = moving_source_rise({}, watts, speed, place - source);
    EXPECT_NEAR((heat.temperature_at(place) - 37) / expected, 1, 0.1) << mm.transpose();
  }
}

// All heat of a half space whose surface lets none out is twice that of a whole one.
TEST(BoneHeat, HeatAtABareSurfaceDoesNotGoIntoTheAir) {
  BoneHeat heat(large(), {});
  heat.add(large(), at(Vec3(0, 0, 0.0119), 1));
  EXPECT_NEAR(heat.energy_j(), 1, 1e-9);
  for (int i = 0; i < 100; ++i) heat.step(large(), 0.1, {}, 0);
  EXPECT_NEAR(heat.energy_j(), 1, 0.003);
  const Vec3 place = on_cell(heat, Vec3(0, 0, 0.0087));
  const double expected = 2 * point_source_rise({}, 1, 0.012 - place.z(), 10);
  EXPECT_NEAR((heat.temperature_at(place) - 37) / expected, 1, 0.15);
}

TEST(BoneHeat, WhatIsCutAwayIsGoneWithItsHeatAndComesBackCold) {
  CarvedField field = large();
  const CarveState whole = field.save();
  BoneHeat heat(field, {});
  heat.add(field, at(Vec3::Zero(), 1));
  heat.step(field, 0.1, {}, 0);
  EXPECT_GT(heat.temperature_at(Vec3::Zero()), 40);
  Pose above;
  above.p = Vec3(0, 0, 0.011);
  for (int k = 0; k <= 10; ++k) {
    Pose to = above;
    to.p.z() = 0.011 - 0.0011 * k;
    (void)field.cut(cutter("drill", 6), above, to);
    above = to;
  }
  heat.step(field, 0.1, {}, 0);
  EXPECT_EQ(heat.temperature_at(Vec3(0, 0, 0.0016)), 37);
  const double kept = heat.hottest_c();
  EXPECT_GT(kept, 40);  // it was so hot
  ASSERT_TRUE(field.restore(whole));
  heat.step(field, 0.1, {}, 0);
  EXPECT_LT(heat.temperature_at(Vec3(0, 0, 0.004)), 40);
  EXPECT_EQ(heat.hottest_c(), kept);
}

// A cut along the surface is followed wherever it goes, also to a place far from the first.
TEST(BoneHeat, PlacesFarApartAreFollowedWithFewBlocksBetween) {
  BoneHeat heat(large(), {});
  for (const double x : {-0.010, 0.010}) {
    heat.add(large(), at(Vec3(x, 0, 0), 1));
    heat.step(large(), 0.5, {}, 0);
  }
  EXPECT_GT(heat.temperature_at(Vec3(-0.010, 0, 0)), 45);
  EXPECT_GT(heat.temperature_at(Vec3(0.010, 0, 0)), 45);
  EXPECT_EQ(heat.temperature_at(Vec3::Zero()), 37);
  EXPECT_LT(heat.blocks(), 40u);
}

TEST(BoneHeat, WaterCoolsTheWallTheMoreOfItFlowsAndNeverBelowItself) {
  CarvedField field = large();
  Pose from, to;
  from.p.z() = 0.012;
  to.p.z() = 0.009;
  (void)field.cut(cutter("drill", 3), from, to);
  const auto warmed = [&](double ml_per_min) {
    BoneHeat heat(field, {});
    HeatSource rim = at(Vec3(0, 0, 0.0096), 0.05, 0.0015);
    rim.ball = false;
    double coldest = 37;
    for (int i = 0; i < 100; ++i) {
      heat.add(field, rim);
      heat.step(field, 0.05, {20, 2000}, ml_per_min * 1e-6 / 60);
      coldest = std::min(coldest, heat.temperature_at(Vec3(0.0016, 0, 0.0112)));
    }
    EXPECT_GE(coldest, 20);
    return heat.hottest_c();
  };
  const double dry = warmed(0), little = warmed(5), usual = warmed(100);
  EXPECT_LT(little, dry - 0.2);
  EXPECT_LT(usual, little - 0.2);
}

TEST(BoneHeat, AStreamTakesNoMoreThanItCanCarry) {
  EXPECT_EQ(rinse_share(1, 0), 0);
  EXPECT_EQ(rinse_share(0, 1), 0);
  // 1 ml/s carries 4.18 W/K.
  EXPECT_NEAR(1e6 * rinse_share(1e6, 1e-6), 4.18, 1e-6);
  EXPECT_NEAR(rinse_share(1e-3, 1e-6), 1, 1e-3);
  EXPECT_NEAR(rinse_share(4.18, 1e-6), 1 - std::exp(-1), 1e-9);
}

TEST(BoneHeat, NecrosisTakesTimeAboveTheLimitAndIsShown) {
  BoneHeat heat(large(), {});
  const auto warm = [&](double seconds) {
    for (double t = 0; t < seconds - 0.25; t += 0.5) {
      heat.add(large(), at(Vec3::Zero(), 0.25));
      heat.step(large(), 0.5, {}, 0);
    }
  };
  const auto dead_cells = [&] {
    std::size_t count = 0;
    for (const auto& cell : heat.volume().cells) count += cell[1] == 255;
    return count;
  };
  warm(20);
  EXPECT_GT(heat.hottest_c(), 55);
  EXPECT_EQ(heat.necrosis_m3(0), 0);
  EXPECT_EQ(heat.necrosis_m3(1), 0);
  EXPECT_EQ(dead_cells(), 0u);
  warm(20);
  EXPECT_EQ(heat.necrosis_m3(0), 0);  // 47 C takes 60 s
  EXPECT_GT(heat.necrosis_m3(1), 0);  // 50 C takes 30 s
  EXPECT_NEAR(static_cast<double>(dead_cells()) * std::pow(heat.cell_m(), 3), heat.necrosis_m3(1),
              1e-15);
  warm(120);
  EXPECT_GT(heat.necrosis_m3(0), heat.necrosis_m3(1) * 0.99);
}

TEST(BoneHeat, TheVolumeTellsTheHottestAlsoBesideTheSurface) {
  BoneHeat heat(large(), {});
  heat.add(large(), at(Vec3(0, 0, 0.0119), 1));
  heat.step(large(), 0.05, {}, 0);
  for (int i = 0; i < 200; ++i) heat.step(large(), 0.5, {}, 0);
  const HeatVolume volume = heat.volume();
  ASSERT_EQ(volume.cells.size(), static_cast<std::size_t>(volume.count[0]) *
                                     static_cast<std::size_t>(volume.count[1]) *
                                     static_cast<std::size_t>(volume.count[2]));
  const auto shown = [&](const Vec3& p_B) {
    const Vec3 u = (p_B - volume.lo_B) / volume.cell_m;
    const auto i = std::lround(u.x()), j = std::lround(u.y()), k = std::lround(u.z());
    return HeatVolume::celsius_of(
        volume.cells[static_cast<std::size_t>((k * volume.count[1] + j) * volume.count[0] + i)][0]);
  };
  EXPECT_LT(heat.temperature_at(Vec3(0, 0, 0.0115)), 40);  // long cold again
  EXPECT_GT(shown(Vec3(0, 0, 0.0115)), 60);
  EXPECT_GT(shown(Vec3(0, 0, 0.0124)), 60);  // the cell over the surface
  EXPECT_GT(heat.hottest_at(Vec3(0, 0, 0.012)), 60);
}

TEST(BoneHeat, BytesOfTemperaturesComeBack) {
  EXPECT_EQ(HeatVolume::byte_of(20), 0);
  EXPECT_EQ(HeatVolume::byte_of(200), 255);
  for (const double c : {37.0, 47.0, 50.0, 69.0})
    EXPECT_NEAR(HeatVolume::celsius_of(HeatVolume::byte_of(c)), c, 0.07);
}

}  // namespace
}  // namespace osteon
