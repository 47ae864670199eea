#include "surface/coarser_levels.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "../scenes.h"

namespace osteon {
namespace {

ShadedMesh prepared_ball(double radius_m) {
  Case one;
  one.bones.push_back(make_bone("ball", sphere_mesh(radius_m), Vec3::Zero()));
  return prepare_case(one).bones[0];
}

Vec3 at(const ShadedMesh& mesh, std::uint32_t v) {
  const auto& p = mesh.positions[v];
  return {static_cast<double>(p[0]), static_cast<double>(p[1]), static_cast<double>(p[2])};
}

/// Every edge once each way.
bool is_closed(const std::vector<Triangle>& triangles) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
  for (const Triangle& t : triangles)
    for (std::size_t k = 0; k < 3; ++k) ++edges[{t[k], t[(k + 1) % 3]}];
  for (const auto& [edge, count] : edges)
    if (count != 1 || !edges.contains({edge.second, edge.first})) return false;
  return !edges.empty();
}

TEST(CoarserLevels, NothingAndNextToNothingHaveNone) {
  EXPECT_TRUE(coarser_levels({}).empty());
  ShadedMesh one;
  one.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  one.normals.assign(3, {0, 0, 1});
  one.shades.assign(3, {255, 128, 128, 0});
  one.triangles = {{0, 1, 2}};
  EXPECT_TRUE(coarser_levels(one).empty());
}

TEST(CoarserLevels, EachIsCoarserStaysClosedAndNamesVerticesOfTheMesh) {
  const ShadedMesh ball = prepared_ball(0.01);
  ASSERT_GE(ball.coarser.size(), 3u);
  std::size_t before = ball.triangles.size();
  double error_m = 0;
  for (const ShadedMesh::Level& level : ball.coarser) {
    EXPECT_LT(level.triangles.size(), 0.76 * static_cast<double>(before));
    EXPECT_GT(level.error_m, error_m);
    EXPECT_TRUE(is_closed(level.triangles));
    for (const Triangle& t : level.triangles)
      for (const std::uint32_t v : t) ASSERT_LT(v, ball.positions.size());
    before = level.triangles.size();
    error_m = level.error_m;
  }
}

TEST(CoarserLevels, StayNearTheBall) {
  const double radius_m = 0.01;
  const ShadedMesh ball = prepared_ball(radius_m);
  for (const ShadedMesh::Level& level : ball.coarser) {
    double worst = 0, sum = 0;
    for (const Triangle& t : level.triangles) {
      const Vec3 middle = (at(ball, t[0]) + at(ball, t[1]) + at(ball, t[2])) / 3;
      worst = std::max(worst, radius_m - middle.norm());
      sum += radius_m - middle.norm();
    }
    // A quadric's error is a mean over the triangles that were joined; the ball's own facets lie
    // 5 um inside it.
    EXPECT_LT(sum / static_cast<double>(level.triangles.size()), 1.2 * level.error_m + 6e-6);
    EXPECT_LT(worst, 4 * level.error_m + 6e-6);
  }
}

/// Flat square of 20 mm that faces +z.
ShadedMesh plate() {
  constexpr std::uint32_t kSide = 60;
  ShadedMesh mesh;
  for (std::uint32_t y = 0; y <= kSide; ++y)
    for (std::uint32_t x = 0; x <= kSide; ++x)
      mesh.positions.push_back(
          {0.02f * static_cast<float>(x) / kSide, 0.02f * static_cast<float>(y) / kSide, 0});
  mesh.normals.assign(mesh.positions.size(), {0, 0, 1});
  mesh.shades.assign(mesh.positions.size(), {255, 128, 128, 0});
  for (std::uint32_t y = 0; y < kSide; ++y) {
    for (std::uint32_t x = 0; x < kSide; ++x) {
      const std::uint32_t a = y * (kSide + 1) + x, b = a + kSide + 1;
      mesh.triangles.push_back({a, a + 1, b});
      mesh.triangles.push_back({a + 1, b + 1, b});
    }
  }
  return mesh;
}

TEST(CoarserLevels, ShadesThatTrianglesCannotFollowKeepTheirVertices) {
  const ShadedMesh plain = plate();
  ShadedMesh shadowed = plain;  // a round shadow in the middle
  for (std::size_t k = 0; k < shadowed.shades.size(); ++k) {
    const auto& p = shadowed.positions[k];
    const double r = std::hypot(static_cast<double>(p[0]) - 0.01, static_cast<double>(p[1]) - 0.01);
    shadowed.shades[k].openness = static_cast<std::uint8_t>(255 - 200 * std::exp(-r * r / 9e-6));
  }
  const auto of_plain = coarser_levels(plain), of_shadowed = coarser_levels(shadowed);
  ASSERT_FALSE(of_plain.empty());
  ASSERT_FALSE(of_shadowed.empty());
  EXPECT_LT(of_plain.back().triangles.size(), 100u);
  EXPECT_GT(of_shadowed.back().triangles.size(), 2 * of_plain.back().triangles.size());
}

TEST(CoarserLevels, AStoppedPreparationHasNone) {
  Case one;
  one.bones.push_back(make_bone("ball", sphere_mesh(0.01), Vec3::Zero()));
  const PreparedCase stopped = prepare_case(one, [](double) { return false; });
  EXPECT_TRUE(stopped.bones.at(0).coarser.empty());
  EXPECT_FALSE(stopped.bones.at(0).triangles.empty());
}

}  // namespace
}  // namespace osteon
