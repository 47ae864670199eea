#include "spatial_order.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <set>

#include "initial_simplex.h"
#include "shapes.h"

namespace osteon::hull {
namespace {

using test::Points;

std::vector<std::uint32_t> all(std::size_t n) {
  std::vector<std::uint32_t> indices(n);
  std::iota(indices.begin(), indices.end(), 0u);
  return indices;
}

TEST(SpatialOrder, HoldsEveryPointOnceButTheVertices) {
  Random random(41);
  const Points points = test::ball(random, 5000);
  const Cloud cloud(points, finite_box(points));
  const Simplex simplex = find_simplex(cloud);
  Polytope polytope(cloud, simplex.corners);
  const SpatialOrder order = spatial_order(cloud, polytope, all(points.size()));
  EXPECT_EQ(order.copies, 0u);
  std::set<std::uint32_t> seen(order.points.begin(), order.points.end());
  EXPECT_EQ(order.points.size(), points.size() - 4);
  EXPECT_EQ(seen.size(), points.size() - 4);
  for (const std::uint32_t corner : simplex.corners) EXPECT_FALSE(seen.contains(corner));
}

// A random order has steps of about the sphere's radius.
TEST(SpatialOrder, NeighboursFollowOneAnother) {
  Random random(42);
  const Points points = test::sphere(random, 20000);
  const Cloud cloud(points, finite_box(points));
  Polytope polytope(cloud, find_simplex(cloud).corners);
  const SpatialOrder order = spatial_order(cloud, polytope, all(points.size()));
  double way = 0;
  for (std::size_t i = 1; i < order.points.size(); ++i) {
    way += (points[order.points[i]] - points[order.points[i - 1]]).norm();
  }
  EXPECT_LT(way / 20000, 2 * std::sqrt(4 * 3.1416 / 20000));
}

TEST(SpatialOrder, TheFirstOfCopiesStays) {
  const Points once = test::lattice(4);
  Points points = once;
  for (int copy = 0; copy < 3; ++copy) points.insert(points.end(), once.begin(), once.end());
  points[70].z() = points[70].z() == 0 ? -0.0 : points[70].z();
  const Cloud cloud(points, finite_box(points));
  // Vertices from the last copy: they are to be named for the first.
  std::array<std::uint32_t, 4> corners = find_simplex(cloud).corners;
  for (std::uint32_t& corner : corners) corner = corner % 64 + 192;
  Polytope polytope(cloud, corners);
  const SpatialOrder order = spatial_order(cloud, polytope, all(points.size()));
  EXPECT_EQ(order.copies, 3u * 64);
  EXPECT_EQ(order.points.size(), 60u);
  for (const std::uint32_t i : order.points) EXPECT_LT(i, 64u);
  for (const Polytope::Vertex& v : polytope.vertices()) EXPECT_LT(v.source, 64u);
}

TEST(SpatialOrder, ManyPointsOfOneDirection) {
  Points points = test::box_corners();
  for (int i = 1; i < 500; ++i) points.push_back(Vec3::Constant(0.5) + i * 1e-3 * Vec3(1, 1, 1));
  const Cloud cloud(points, finite_box(points));
  Polytope polytope(cloud, find_simplex(cloud).corners);
  EXPECT_EQ(spatial_order(cloud, polytope, all(points.size())).points.size(), points.size() - 4);
}

}  // namespace
}  // namespace osteon::hull
