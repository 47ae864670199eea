#include "recognise/point_cloud.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "osteon/base/random.h"

namespace osteon {
namespace {

// Nothing of a scan is a kilometre away.
TEST(PointCloud, OfNoPointsFindsNoneNear) {
  EXPECT_GT(PointCloud({}).nearest(Vec3::Zero()).distance_m, 1e3);
}

TEST(PointCloud, FindsTheNearestFarFromTheOrigin) {
  Random random(1);
  const Vec3 far(0.4, -0.7, 1.2);
  std::vector<Vec3> points;
  for (int i = 0; i < 501; ++i) points.push_back(far + 0.05 * random.direction());
  const PointCloud cloud(points);
  ASSERT_EQ(cloud.size(), points.size());
  for (int i = 0; i < 200; ++i) {
    const Vec3 p = far + 0.06 * random.direction();
    double least = 1e9;
    for (const Vec3& q : points) least = std::min(least, (q - p).norm());
    const PointCloud::Hit hit = cloud.nearest(p);
    EXPECT_NEAR(hit.distance_m, least, 1e-7);
    ASSERT_LT(hit.index, points.size());
    EXPECT_NEAR((points[hit.index] - p).norm(), least, 1e-7);
  }
}

// The middle of a cube's face is as near to its four corners; corners repeat as well.
TEST(PointCloud, OfPointsAsNearItFindsTheFirst) {
  std::vector<Vec3> points;
  for (int round = 0; round < 40; ++round)
    for (int i = 0; i < 8; ++i) points.push_back(Vec3(i & 1, (i >> 1) & 1, (i >> 2) & 1));
  const PointCloud cloud(points);
  EXPECT_EQ(cloud.nearest(Vec3(0.5, 0.5, 0)).index, 0u);
  EXPECT_EQ(cloud.nearest(Vec3(1, 0.5, 0.5)).index, 1u);
  EXPECT_EQ(cloud.nearest(Vec3(0.5, 0.5, 1)).index, 4u);
  EXPECT_EQ(cloud.nearest(Vec3(0.5, 0.5, 0.5)).index, 0u);
}

TEST(Thinned, LeavesAboutAsManyAsAskedAndAllOfFewer) {
  const std::vector<Vec3> points(1000, Vec3::Ones());
  EXPECT_EQ(thinned(points, 2000).size(), 1000u);
  EXPECT_GE(thinned(points, 100).size(), 100u);
  EXPECT_LE(thinned(points, 100).size(), 110u);
  EXPECT_TRUE(thinned({}, 10).empty());
}

}  // namespace
}  // namespace osteon
