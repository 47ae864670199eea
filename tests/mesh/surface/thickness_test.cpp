#include "osteon/mesh/thickness.h"

#include <gtest/gtest.h>

#include "mesh/shapes.h"
#include "mesh/solids.h"
#include "osteon/mesh/measure.h"

namespace osteon {
namespace {

TEST(Thickness, OfNothingIsNothing) {
  EXPECT_TRUE(thickness_samples(MeshDistance(TriMesh{}), 100, 1).empty());
  EXPECT_EQ(thickness_quantile({}, 0.5), 0);
}

TEST(Thickness, ABallIsAsThickAsItsDiameter) {
  const auto samples = thickness_samples(MeshDistance(test::sphere(0.01, 24)), 100, 1);
  EXPECT_NEAR(thickness_quantile(samples, 0.5), 0.02, 1e-3);
  EXPECT_NEAR(thickness_quantile(samples, 0.02), 0.02, 1e-3);
  const auto bounded = thickness_samples(MeshDistance(test::sphere(0.01, 24)), 100, 0.007);
  EXPECT_EQ(thickness_quantile(bounded, 0.5), 0.007);
}

// But at its walls, where a ball also touches the top or the bottom.
TEST(Thickness, AFlatRingIsAsThickAsItIsHigh) {
  const auto samples =
      thickness_samples(MeshDistance(test::flat_ring(0.01, 0.006, 0.0008, 96)), 400, 1);
  EXPECT_NEAR(thickness_quantile(samples, 0.3), 0.0008, 1e-6);
  EXPECT_NEAR(thickness_quantile(samples, 0.9), 0.0008, 1e-6);
}

TEST(Thickness, AHollowBallIsAsThickAsItsWall) {
  TriMesh hollow = test::sphere(0.009, 32);
  for (Triangle& t : hollow.triangles) test::flip(t);
  const TriMesh shell = test::joined(test::sphere(0.01, 32), hollow);
  const auto samples = thickness_samples(MeshDistance(shell), 5000, 0.01);
  EXPECT_NEAR(thickness_quantile(samples, 0.5), 0.001, 5e-5);
  double whole = 0;
  for (const ThicknessSample& s : samples) whole += s.area_m2;
  EXPECT_NEAR(whole / area(shell), 1, 1e-12);
}

}  // namespace
}  // namespace osteon
