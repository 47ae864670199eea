#include "osteon/carve/heat.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace osteon {
namespace {

Aabb box_mm(double half) {
  Aabb box;
  box.include(Vec3::Constant(-half * 1e-3));
  box.include(Vec3::Constant(half * 1e-3));
  return box;
}

TEST(Heat, RefusesAGridThatIsNone) {
  EXPECT_FALSE(HeatGrid::make(Aabb{}, 1e-3));
  EXPECT_FALSE(HeatGrid::make(box_mm(5), 0));
  EXPECT_FALSE(HeatGrid::make(box_mm(5), std::numeric_limits<double>::quiet_NaN()));
  EXPECT_FALSE(HeatGrid::make(box_mm(5), 1e-6));  // too many cells
  HeatMaterial cold;
  cold.conductivity_w_per_m_k = 0;
  EXPECT_FALSE(HeatGrid::make(box_mm(5), 1e-3, cold));
}

TEST(Heat, APointSourceSpreadsAsItsClosedForm) {
  auto grid = HeatGrid::make(box_mm(16), 1e-3);
  ASSERT_TRUE(grid);
  grid->add_heat(Vec3::Zero(), 1);
  EXPECT_NEAR(grid->energy_j(), 1, 1e-9);
  grid->step(10);
  const HeatMaterial m;
  for (const double r_mm : {0.0, 1.0, 2.0, 3.0, 4.0}) {
    const double expected = point_source_rise(m, 1, r_mm * 1e-3, 10);
    EXPECT_NEAR((grid->temperature_at(Vec3(r_mm * 1e-3, 0, 0)) - 37) / expected, 1, 0.1) << r_mm;
  }
}

TEST(Heat, AMovingSourceAgreesWithRosenthalWithinTenPercent) {
  Aabb box;
  box.include(Vec3(-9, -12, -12) * 1e-3);
  box.include(Vec3(27, 12, 12) * 1e-3);
  auto grid = HeatGrid::make(box, 0.75e-3);
  ASSERT_TRUE(grid);
  // It ends on a node of the grid.
  const double speed = 0.1e-3, watts = 0.5, dt = 0.1;
  Vec3 source(0, 0, 0);
  for (int i = 0; i < 1500; ++i) {
    grid->add_heat(source, watts * dt);
    grid->step(dt);
    source.x() += speed * dt;
  }
  const HeatMaterial m;
  const Vec3 places_mm[] = {{-3, 0, 0}, {3, 0, 0}, {-3, 3, 0}, {0, 3, 0}, {-4, 0, 3}, {0, 2, -2}};
  for (const Vec3& mm : places_mm) {
    const Vec3 from = mm * 1e-3;
    const double expected = moving_source_rise(m, watts, speed, from);
    EXPECT_NEAR((grid->temperature_at(source + from) - 37) / expected, 1, 0.1) << mm.transpose();
  }
}

TEST(Heat, TheMovingSourceIsTheSumOfPointSources) {
  const HeatMaterial m;
  const double speed = 0.4e-3, watts = 0.5, dt = 0.01;
  const Vec3 from(-3e-3, 2e-3, 0);
  double sum = 0;
  for (double ago = 0.5 * dt; ago < 2000; ago += dt)
    sum += point_source_rise(m, watts * dt, (from + Vec3(speed * ago, 0, 0)).norm(), ago);
  EXPECT_NEAR(moving_source_rise(m, watts, speed, from) / sum, 1, 0.02);
}

TEST(Heat, WhatIsGoneConductsNothing) {
  auto grid = HeatGrid::make(box_mm(8), 1e-3);
  ASSERT_TRUE(grid);
  grid->open(Vec3(0, 0, 0), Vec3(0, 0, 0), 2.1e-3);
  grid->add_heat(Vec3(4e-3, 0, 0), 1);
  const double before = grid->energy_j();
  grid->step(2);
  EXPECT_NEAR(grid->energy_j(), before, 1e-3);  // what little reached the box's rim
  EXPECT_EQ(grid->temperature_at(Vec3::Zero()), 37);
}

TEST(Heat, WaterCoolsTheWallAndNeverBelowItself) {
  auto dry = HeatGrid::make(box_mm(8), 1e-3);
  auto wet = HeatGrid::make(box_mm(8), 1e-3);
  ASSERT_TRUE(dry && wet);
  for (HeatGrid* grid : {&*dry, &*wet}) {
    grid->open(Vec3(0, 0, -5e-3), Vec3(0, 0, 5e-3), 1.2e-3);
    grid->add_heat(Vec3(3e-3, 0, 0), 2);
    for (int i = 0; i < 50; ++i) {
      grid->step(0.2);
      if (grid == &*wet) grid->irrigate({20, 3000}, 0.2);
    }
  }
  EXPECT_LT(wet->hottest_c(), dry->hottest_c() - 0.5);
  EXPECT_LT(wet->temperature_at(Vec3(2e-3, 0, 0)), 37);
  EXPECT_GT(wet->temperature_at(Vec3(2e-3, 0, 0)), 20);
}

TEST(Heat, NecrosisTakesTimeAboveTheLimit) {
  auto grid = HeatGrid::make(box_mm(8), 1e-3);
  ASSERT_TRUE(grid);
  const auto warm = [&](double seconds) {
    for (double t = 0; t < seconds; t += 0.5) {
      grid->add_heat(Vec3::Zero(), 0.25);
      grid->step(0.5);
    }
  };
  warm(20);
  EXPECT_GT(grid->hottest_c(), 55);
  EXPECT_EQ(grid->necrosis_m3(0), 0);
  EXPECT_EQ(grid->necrosis_m3(1), 0);
  warm(20);
  EXPECT_EQ(grid->necrosis_m3(0), 0);  // 47 C takes 60 s
  EXPECT_GT(grid->necrosis_m3(1), 0);  // 50 C takes 30 s
  warm(120);
  EXPECT_GT(grid->necrosis_m3(0), grid->necrosis_m3(1) * 0.99);
}

}  // namespace
}  // namespace osteon
