#include "osteon/carve/piece_shape.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "osteon/mesh/measure.h"

namespace osteon {
namespace {

// A ball of that radius about the middle of a grid, in whole micrometres as fields are.
PieceGrid ball_grid(double radius_m, double cell_m, const Vec3& middle) {
  PieceGrid grid;
  grid.bone = 3;
  grid.cell_m = cell_m;
  const int half = static_cast<int>(std::ceil(radius_m / cell_m)) + 2;
  grid.nodes = {2 * half + 1, 2 * half + 1, 2 * half + 1};
  grid.lo_B = middle - cell_m * Vec3(half, half, half);
  for (int k = -half; k <= half; ++k)
    for (int j = -half; j <= half; ++j)
      for (int i = -half; i <= half; ++i)
        grid.heights.push_back(static_cast<std::int16_t>(
            std::lround(1e6 * (cell_m * Vec3(i, j, k).norm() - radius_m))));
  return grid;
}

TEST(PieceShape, WhatDoesNotFitTogetherIsRefused) {
  EXPECT_EQ(PieceShape::from({}), nullptr);
  PieceGrid grid = ball_grid(0.002, 0.00025, Vec3::Zero());
  grid.heights.pop_back();
  EXPECT_EQ(PieceShape::from(grid), nullptr);
  grid = ball_grid(0.002, 0.00025, Vec3::Zero());
  grid.nodes = {1 << 20, 1 << 20, 1 << 20};
  EXPECT_EQ(PieceShape::from(grid), nullptr);
  grid = ball_grid(0.002, 0.00025, Vec3(std::nan(""), 0, 0));
  EXPECT_EQ(PieceShape::from(grid), nullptr);
  grid = ball_grid(0.002, 0.00025, Vec3::Zero());
  for (std::int16_t& height : grid.heights) height = 100;  // nothing is inside
  EXPECT_EQ(PieceShape::from(grid), nullptr);
}

// Volume 4/3 pi r^3; the mean of (p - middle)(p - middle)^T of a ball is r^2 / 5.
TEST(PieceShape, ABallHasTheVolumeAndTheSpreadOfABall) {
  const double r = 0.00311;  // no node lies on it
  const Vec3 middle(0.01, -0.02, 0.005);
  const auto shape = PieceShape::from(ball_grid(r, 0.00025, middle));
  ASSERT_NE(shape, nullptr);
  const double volume = 4.0 / 3 * std::numbers::pi * r * r * r;
  EXPECT_NEAR(shape->volume_m3(), volume, 0.01 * volume);
  EXPECT_LT((shape->middle_B() - middle).norm(), 1e-9);
  EXPECT_LT((shape->spread_m2() - 0.2 * r * r * Mat3::Identity()).norm(), 0.02 * r * r);
  EXPECT_NEAR(shape->reach_m(), r, 3e-6);
}

TEST(PieceShape, ItsPointsLieOnTheSurfaceAndFarFromEachOther) {
  const double r = 0.003;
  const auto shape = PieceShape::from(ball_grid(r, 0.00025, Vec3::Zero()));
  ASSERT_NE(shape, nullptr);
  const auto& points = shape->points_B();
  ASSERT_EQ(points.size(), PieceShape::kMostPoints);
  for (std::size_t i = 0; i < points.size(); ++i) {
    EXPECT_NEAR(points[i].norm(), r, 5e-6);
    // 48 caps that do not overlap on a sphere cannot lie farther apart than about 0.54 r.
    for (std::size_t k = 0; k < i; ++k) EXPECT_GT((points[i] - points[k]).norm(), 0.3 * r);
  }
}

TEST(PieceShape, ItsSurfaceIsClosedAndTheBalls) {
  const double r = 0.003;
  const auto shape = PieceShape::from(ball_grid(r, 0.00025, Vec3::Zero()));
  ASSERT_NE(shape, nullptr);
  const auto mesh = shape->surface();
  ASSERT_TRUE(mesh) << mesh.error().message();
  for (const Vec3& v : mesh->vertices) EXPECT_NEAR(v.norm(), r, 3e-5);
  const double volume = 4.0 / 3 * std::numbers::pi * r * r * r;
  EXPECT_TRUE(topology(*mesh).closed());
  EXPECT_NEAR(osteon::volume(*mesh), volume, 0.01 * volume);
}

// Of nodes deep inside a field knows no more than that: their heights are the lowest that there
// are.
TEST(PieceShape, ItsSurfaceNeedsNoDepths) {
  const double r = 0.008;
  PieceGrid grid = ball_grid(r, 0.00025, Vec3::Zero());
  for (std::int16_t& height : grid.heights)
    if (height < -1000) height = -32767;
  const auto shape = PieceShape::from(std::move(grid));
  ASSERT_NE(shape, nullptr);
  const auto mesh = shape->surface();
  ASSERT_TRUE(mesh) << mesh.error().message();
  for (const Vec3& v : mesh->vertices) EXPECT_NEAR(v.norm(), r, 3e-5);
  EXPECT_TRUE(topology(*mesh).closed());
}

}  // namespace
}  // namespace osteon
