#include "osteon/collide/convex_body.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "collide/shapes.h"

namespace osteon {
namespace {

// Coordinates of `target` in the cone (affine: tetrahedron) of the normals of `planes`.
Eigen::Vector4d depth_weights(const ConvexBody& b) {
  Eigen::Matrix4d m;
  for (int k = 0; k < 4; ++k) m.col(k) << b.normal(b.basis[static_cast<std::size_t>(k)]), 1.0;
  return m.inverse() * Eigen::Vector4d(0, 0, 0, 1);
}

Vec3 corner_weights(const ConvexBody& b) {
  Mat3 m;
  for (int k = 0; k < 3; ++k) m.col(k) = b.normal(b.corner[static_cast<std::size_t>(k)]);
  return m.inverse() * Vec3::Ones();
}

std::vector<std::pair<const char*, Hull>> samples() {
  Random random(3);
  std::vector<std::pair<const char*, Hull>> all;
  all.emplace_back("box", shapes::box({0.01, 0.02, 0.03}));
  all.emplace_back("plate", shapes::box({0.1, 0.1, 1e-6}));
  all.emplace_back("needle", shapes::box({1e-5, 1e-5, 0.1}));
  all.emplace_back("octahedron", shapes::octahedron({0.01, 0.01, 0.01}));
  all.emplace_back("thin octahedron", shapes::octahedron({1e-5, 0.03, 0.01}));
  all.emplace_back("cone", shapes::cone(24, 0.001, 0.05));
  all.emplace_back("tiny", shapes::box({1e-7, 2e-7, 1e-7}));
  all.emplace_back("huge", shapes::box({1e4, 2e4, 1e4}));
  all.emplace_back("far", shapes::box({0.01, 0.01, 0.01}, {100, -200, 50}));
  all.emplace_back("ellipsoid", shapes::ellipsoid(3, {0.01, 0.015, 0.04}));
  for (int i = 0; i < 10; ++i)
    all.emplace_back("random", shapes::random_hull(random, 5 + i, {0.01, 0.02, 0.005}));
  return all;
}

TEST(ConvexBody, HoldsEveryPlaneAndVertexOnceAndPads) {
  for (const auto& [name, hull] : samples()) {
    SCOPED_TRACE(name);
    const ConvexBody b = make_convex_body(hull);
    ASSERT_EQ(b.plane_count, hull.planes.size());
    ASSERT_EQ(b.vertex_count, hull.vertices.size());
    EXPECT_EQ(b.nx.size() % ConvexBody::kBlock, 0u);
    EXPECT_EQ(b.vx.size() % ConvexBody::kBlock, 0u);
    for (std::uint32_t i = 0; i < b.nx.size(); ++i) {
      const Plane& plane = hull.planes[b.plane_source[std::min(i, b.plane_count - 1)]];
      EXPECT_EQ(b.normal(i), plane.n);
      EXPECT_EQ(b.d[i], plane.d);
    }
    for (std::uint32_t i = 0; i < b.vx.size(); ++i)
      EXPECT_EQ(b.vertex(i), hull.vertices[b.vertex_source[std::min(i, b.vertex_count - 1)]]);
    const std::set<std::uint32_t> planes(b.plane_source.begin(), b.plane_source.end());
    EXPECT_EQ(planes.size(), hull.planes.size());
  }
}

TEST(ConvexBody, SphereHoldsEveryVertexAndIsTight) {
  for (const auto& [name, hull] : samples()) {
    SCOPED_TRACE(name);
    const ConvexBody b = make_convex_body(hull);
    double farthest = 0;
    for (const Vec3& v : hull.vertices) {
      farthest = std::max(farthest, (v - b.center).norm());
      EXPECT_TRUE((b.box.lo.array() <= v.array()).all() && (v.array() <= b.box.hi.array()).all());
    }
    EXPECT_LE(farthest, b.radius);
    // No sphere is smaller than half the diameter of the box's longest side allows.
    EXPECT_LE(b.radius, 1.02 * std::sqrt(3.0) * b.box.extent().maxCoeff() / 2);
    for (const Plane& plane : hull.planes) EXPECT_LE(plane.signed_distance(b.center), 1e-12);
  }
  EXPECT_NEAR(make_convex_body(shapes::box({3, 4, 12})).radius, 13, 0.05);
}

TEST(ConvexBody, FirstBasesAreDualFeasible) {
  for (const auto& [name, hull] : samples()) {
    SCOPED_TRACE(name);
    const ConvexBody b = make_convex_body(hull);
    for (const std::uint32_t id : b.basis) ASSERT_LT(id, b.plane_count);
    for (const std::uint32_t id : b.corner) ASSERT_LT(id, b.plane_count);
    EXPECT_GE(depth_weights(b).minCoeff(), -1e-10);
    EXPECT_GE(corner_weights(b).minCoeff(), -1e-9);
  }
}

TEST(Support, EqualsTheLargestOverAllVertices) {
  Random random(5);
  for (const auto& [name, hull] : samples()) {
    SCOPED_TRACE(name);
    const ConvexBody b = make_convex_body(hull);
    for (int i = 0; i < 200; ++i) {
      Vec3 n = random.direction();
      if (i < 3) n = Vec3::Unit(i);
      double largest = -1e300;
      for (const Vec3& v : hull.vertices)
        largest = std::max(largest, v.x() * n.x() + v.y() * n.y() + v.z() * n.z());
      std::uint32_t vertex = 0;
      EXPECT_EQ(support(b, n, &vertex), largest);
      ASSERT_LT(vertex, b.vertex_count);
      EXPECT_NEAR(b.vertex(vertex).dot(n), largest, 1e-15 * (b.radius + b.center.norm()));
    }
  }
}

}  // namespace
}  // namespace osteon
