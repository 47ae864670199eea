#include "bone/surface_samples.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace osteon {
namespace {

// Two squares of 10 mm and 20 mm side, in planes of their own.
TriMesh two_squares() {
  TriMesh mesh;
  mesh.vertices = {{0, 0, 0},    {0.01, 0, 0},    {0.01, 0.01, 0},    {0, 0.01, 0},
                   {0, 0, 0.05}, {0.02, 0, 0.05}, {0.02, 0.02, 0.05}, {0, 0.02, 0.05}};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}, {4, 5, 6}, {4, 6, 7}};
  return mesh;
}

TEST(SurfaceSamples, LieOnTheSurfaceInProportionToItsArea) {
  const std::vector<Vec3> points = surface_samples(two_squares(), 1000);
  ASSERT_EQ(points.size(), 1000u);
  int small = 0;
  for (const Vec3& p : points) {
    ASSERT_TRUE(std::abs(p.z()) < 1e-15 || std::abs(p.z() - 0.05) < 1e-15);
    const bool lower = p.z() < 0.01;
    const double side = lower ? 0.01 : 0.02;
    EXPECT_TRUE(p.x() >= 0 && p.x() <= side && p.y() >= 0 && p.y() <= side) << p.transpose();
    small += lower ? 1 : 0;
  }
  EXPECT_NEAR(small, 200, 2);
}

// Each quarter of the large square gets its share: no corner is left out.
TEST(SurfaceSamples, AreSpreadWithinTheTriangles) {
  int quarter[4] = {};
  for (const Vec3& p : surface_samples(two_squares(), 1000))
    if (p.z() > 0.01) ++quarter[(p.x() > 0.01 ? 1 : 0) + (p.y() > 0.01 ? 2 : 0)];
  for (const int n : quarter) EXPECT_NEAR(n, 200, 20);
}

TEST(SurfaceSamples, AreTheSameEachTime) {
  EXPECT_EQ(surface_samples(two_squares(), 77), surface_samples(two_squares(), 77));
}

}  // namespace
}  // namespace osteon
