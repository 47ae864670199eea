#include "surface/ray_bvh.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "../scenes.h"
#include "osteon/base/random.h"

namespace osteon {
namespace {

/// Independent of the hierarchy: every triangle by the plane it lies in and signed areas.
std::optional<double> hit_by_force(const TriMesh& mesh, const Vec3& origin, const Vec3& dir) {
  std::optional<double> best;
  for (const Triangle& t : mesh.triangles) {
    const Vec3 &a = mesh.vertices[t[0]], &b = mesh.vertices[t[1]], &c = mesh.vertices[t[2]];
    const Vec3 n = (b - a).cross(c - a);
    const double slope = n.dot(dir);
    if (slope == 0) continue;
    const double distance = n.dot(a - origin) / slope;
    const Vec3 p = origin + distance * dir;
    const bool inside = n.dot((b - a).cross(p - a)) >= 0 && n.dot((c - b).cross(p - b)) >= 0 &&
                        n.dot((a - c).cross(p - c)) >= 0;
    if (inside && distance > 0 && (!best || distance < *best)) best = distance;
  }
  return best;
}

TriMesh triangle_soup(Random& random, int count) {
  TriMesh mesh;
  for (int k = 0; k < count; ++k) {
    const Vec3 center = random.direction() * random.uniform(0, 1);
    for (int c = 0; c < 3; ++c) mesh.vertices.push_back(center + 0.2 * random.direction());
    const auto first = static_cast<std::uint32_t>(3 * k);
    mesh.triangles.push_back({first, first + 1, first + 2});
  }
  return mesh;
}

TEST(RayBvh, EmptyAndBrokenMeshesAreNeverHit) {
  EXPECT_FALSE(RayBvh().closest(Vec3::Zero(), Vec3::UnitX(), 1).has_value());
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const std::vector<Vec3> points{Vec3(1, -1, -1), Vec3(1, 1, -1), Vec3(1, 0, nan)};
  const std::vector<Triangle> triangles{{0, 1, 2}, {0, 1, 9}};
  EXPECT_TRUE(RayBvh(points, triangles).empty());
}

TEST(RayBvh, RayThatIsNotFiniteHitsNothing) {
  const TriMesh mesh = sphere_mesh(1);
  const RayBvh bvh(mesh.vertices, mesh.triangles);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(bvh.closest(Vec3(nan, 0, 0), Vec3::UnitX(), 10).has_value());
  EXPECT_FALSE(bvh.closest(Vec3::Zero(), Vec3(nan, 0, 0), 10).has_value());
}

TEST(RayBvh, AgreesWithTestingEveryTriangle) {
  Random random(11);
  const TriMesh mesh = triangle_soup(random, 300);
  const RayBvh bvh(mesh.vertices, mesh.triangles);
  int hits = 0;
  for (int k = 0; k < 2000; ++k) {
    const Vec3 origin = 1.5 * random.direction();
    const Vec3 aim = 0.7 * random.direction();
    const Vec3 dir = (aim - origin).normalized();
    const auto expected = hit_by_force(mesh, origin, dir);
    const auto found = bvh.closest(origin, dir, 100);
    ASSERT_EQ(found.has_value(), expected.has_value());
    if (!found) continue;
    ++hits;
    EXPECT_NEAR(found->t, *expected, 1e-9);
  }
  EXPECT_GT(hits, 500);
}

TEST(RayBvh, AxisParallelRaysInAFlatMesh) {
  // Boxes without thickness and directions with zeros: the slab test divides by zero here.
  TriMesh grid;
  for (int k = 0; k < 400; ++k) {
    const double x = k % 20, y = static_cast<double>(k / 20);
    const auto first = static_cast<std::uint32_t>(grid.vertices.size());
    grid.vertices.insert(grid.vertices.end(),
                         {Vec3(x, y, 0), Vec3(x + 1, y, 0), Vec3(x, y + 1, 0)});
    grid.triangles.push_back({first, first + 1, first + 2});
  }
  const RayBvh bvh(grid.vertices, grid.triangles);
  for (int k = 0; k < 400; ++k) {
    const Vec3 from(k % 20 + 0.25, static_cast<double>(k / 20) + 0.25, 3);
    const auto hit = bvh.closest(from, -Vec3::UnitZ(), 10);
    ASSERT_TRUE(hit.has_value());
    EXPECT_EQ(hit->triangle, static_cast<std::uint32_t>(k));
    EXPECT_DOUBLE_EQ(hit->t, 3);
    EXPECT_FALSE(bvh.closest(from, -Vec3::UnitZ(), 2.9).has_value());
    EXPECT_FALSE(bvh.closest(from, Vec3::UnitZ(), 10).has_value());
  }
}

}  // namespace
}  // namespace osteon
