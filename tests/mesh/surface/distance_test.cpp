#include "osteon/mesh/distance.h"

#include <gtest/gtest.h>

#include <cmath>

#include "mesh/shapes.h"
#include "osteon/base/random.h"
#include "osteon/mesh/measure.h"
#include "surface/closest_on_triangle.h"

namespace osteon {
namespace {

TEST(MeshDistance, EmptyMeshIsInfinitelyFar) {
  EXPECT_TRUE(std::isinf(MeshDistance(TriMesh{}).closest(Vec3(1, 2, 3)).signed_distance));
}

TEST(MeshDistance, ATriangleWithoutAreaIsItsSides) {
  TriMesh m;
  m.vertices = {Vec3(0, 0, 0), Vec3(2, 0, 0), Vec3(1, 0, 0)};
  m.triangles = {{0, 1, 2}};
  const ClosestPoint on_side = MeshDistance(m).closest(Vec3(1.5, 3, 0));
  EXPECT_NEAR(on_side.signed_distance, 3, 1e-12);
  EXPECT_LT((on_side.point - Vec3(1.5, 0, 0)).norm(), 1e-12);
  m.vertices = {Vec3(1, 1, 1), Vec3(1, 1, 1), Vec3(1, 1, 1)};
  EXPECT_NEAR(MeshDistance(m).closest(Vec3(1, 1, 4)).signed_distance, 3, 1e-12);
}

// Every face, edge and corner of a cube, against the box's closed form.
TEST(MeshDistance, AgreesWithTheBoxFormula) {
  const MeshDistance cube(test::cube(1));
  Random random(17);
  for (int i = 0; i < 20000; ++i) {
    const double x = random.uniform(-2, 2);
    const double y = random.uniform(-2, 2);
    const double z = random.uniform(-2, 2);
    const Vec3 p(x, y, z);
    const Vec3 q = p.cwiseAbs() - Vec3::Ones();
    const double wanted = q.cwiseMax(0.0).norm() + std::min(q.maxCoeff(), 0.0);
    const ClosestPoint found = cube.closest(p);
    ASSERT_NEAR(found.signed_distance, wanted, 1e-12) << p.transpose();
    ASSERT_NEAR((found.point - p).norm(), std::abs(wanted), 1e-12);
  }
}

// Oracle for the distance: every triangle, sampled by brute force; for the sign: solid angles.
double winding_number(const TriMesh& mesh, const Vec3& p) {
  double sum = 0;
  for (const Triangle& t : mesh.triangles) {
    const Vec3 a = mesh.vertices[t[0]] - p, b = mesh.vertices[t[1]] - p,
               c = mesh.vertices[t[2]] - p;
    const double la = a.norm(), lb = b.norm(), lc = c.norm();
    sum +=
        std::atan2(a.dot(b.cross(c)), la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb);
  }
  return sum / (2 * M_PI);
}

TEST(MeshDistance, AgreesWithBruteForceOnAKnobblyShape) {
  TriMesh m = test::sphere(1, 14);
  for (Vec3& v : m.vertices) v *= 1 + 0.4 * std::sin(7 * v.x()) * std::cos(5 * v.y() + 3 * v.z());
  const MeshDistance distance(m);
  Random random(18);
  for (int i = 0; i < 1500; ++i) {
    const Vec3 direction = random.direction();
    const Vec3 p = random.uniform(0, 1.8) * direction;
    double best = 1e300;
    std::uint32_t best_triangle = 0;
    for (std::uint32_t t = 0; t < m.triangles.size(); ++t) {
      const Triangle& corner = m.triangles[t];
      const double d = (closest_on_triangle(p, m.vertices[corner[0]], m.vertices[corner[1]],
                                            m.vertices[corner[2]])
                            .point -
                        p)
                           .squaredNorm();
      if (d < best) {
        best = d;
        best_triangle = t;
      }
    }
    const ClosestPoint found = distance.closest(p);
    ASSERT_EQ(std::abs(found.signed_distance), std::sqrt(best));
    ASSERT_EQ(found.triangle, best_triangle);
    const auto guess = static_cast<std::uint32_t>(random.next() % m.triangles.size());
    ASSERT_EQ(distance.closest(p, guess).triangle, best_triangle);
    ASSERT_EQ(distance.distance_to(p, best_triangle), std::sqrt(best));
    ASSERT_GE(distance.distance_to(p, guess), std::sqrt(best));
    ASSERT_EQ(found.signed_distance<0, winding_number(m, p)> 0.5) << p.transpose();
  }
}

// Near edges and corners a plain face normal would give the wrong sign.
TEST(MeshDistance, TheSignHoldsNearSharpEdges) {
  TriMesh spike;
  spike.vertices = {Vec3(0, 0, 10), Vec3(1, 0, 0), Vec3(-0.5, 0.8, 0), Vec3(-0.5, -0.8, 0)};
  spike.triangles = {{0, 1, 2}, {0, 2, 3}, {0, 3, 1}, {1, 3, 2}};
  ASSERT_GT(volume(spike), 0);
  const MeshDistance distance(spike);
  Random random(19);
  for (int i = 0; i < 5000; ++i) {
    const Vec3& corner = spike.vertices[random.next() % 4];
    const Vec3 direction = random.direction();
    const Vec3 p = corner + random.uniform(0, 0.5) * direction;
    ASSERT_EQ(distance.closest(p).signed_distance<0, winding_number(spike, p)> 0.5);
  }
}

// Oracle: no point of a fine grid over the triangle is closer.
TEST(ClosestOnTriangle, NoPointOfTheTriangleIsCloser) {
  Random random(20);
  for (int i = 0; i < 300; ++i) {
    const Vec3 a = random.direction();
    const Vec3 b = random.direction();
    const Vec3 c = i % 5 == 0 ? Vec3(0.5 * (a + b)) : random.direction();
    const Vec3 direction = random.direction();
    const Vec3 p = random.uniform(0, 3) * direction;
    const double found = (closest_on_triangle(p, a, b, c).point - p).norm();
    double sampled = 1e300;
    for (int u = 0; u <= 60; ++u)
      for (int v = 0; u + v <= 60; ++v)
        sampled = std::min(sampled, (a + u / 60.0 * (b - a) + v / 60.0 * (c - a) - p).norm());
    EXPECT_LE(found, sampled + 1e-12);
    EXPECT_GE(found, sampled - 0.04);
  }
}

}  // namespace
}  // namespace osteon
