#include "offset_surface.h"

#include <gtest/gtest.h>

#include "phantoms.h"

namespace osteon {
namespace {

using namespace testing_xray;

TEST(OffsetSurface, ABallShrinksAndGrowsByItsRadius) {
  const TriMesh from = ball(Vec3::Zero(), 0.01);
  for (const double by : {-0.004, 0.003})
    for (const Vec3& v : offset_surface(from, by).vertices) EXPECT_NEAR(v.norm(), 0.01 + by, 1e-5);
}

TEST(OffsetSurface, TheFacesOfABoxMoveByTheirDistance) {
  const TriMesh in = offset_surface(box(Vec3::Constant(-0.01), Vec3::Constant(0.01)), -0.002);
  for (const Vec3& v : in.vertices)
    for (int axis = 0; axis < 3; ++axis) EXPECT_NEAR(std::abs(v[axis]), 0.008, 1e-5);
}

/// What is thinner than twice the depth turns inside out, and holds nothing.
TEST(OffsetSurface, AThinPartIsLeftOut) {
  const TriMesh turned = offset_surface(ball(Vec3::Zero(), 0.001), -0.0015);
  const auto got = areal_density({{layer(turned, 1)}}, view_from_above(33, 0.0001));
  ASSERT_TRUE(got);
  for (const float v : got->total()) EXPECT_EQ(v, 0);
}

}  // namespace
}  // namespace osteon
