#include "osteon/anatomy/bone_gaps.h"

#include <gtest/gtest.h>

#include "mesh/shapes.h"

namespace osteon {
namespace {

TEST(BoneGaps, NoneAndOneBoneHaveNone) {
  EXPECT_TRUE(bone_gaps({}, 0.01).empty());
  const std::vector<TriMesh> one = {test::sphere(0.01, 8)};
  EXPECT_TRUE(bone_gaps(one, 0.01).empty());
}

TEST(BoneGaps, SpheresHaveTheirGapsAndDepths) {
  const double r = 0.01;
  const std::vector<TriMesh> balls = {
      test::sphere(r, 40), test::sphere(r, 40, Vec3(0, 0, 0.0215)),  // 1.5 mm above the first
      test::sphere(r, 40, Vec3(0, 0, -0.0192)),                      // 0.8 mm into the first
      test::sphere(r, 40, Vec3(0, 0, 0.05))};
  const auto gaps = bone_gaps(balls, 0.003);
  ASSERT_EQ(gaps.size(), 2u);
  EXPECT_EQ(gaps[0].first, 0u);
  EXPECT_EQ(gaps[0].second, 1u);
  EXPECT_NEAR(gaps[0].gap_m, 0.0015, 1e-6);
  EXPECT_EQ(gaps[1].second, 2u);
  EXPECT_NEAR(gaps[1].gap_m, -0.0008, 1e-6);
  const auto meeting = bone_gaps(balls, 0);
  ASSERT_EQ(meeting.size(), 1u);
  EXPECT_EQ(meeting[0].second, 2u);
}

}  // namespace
}  // namespace osteon
