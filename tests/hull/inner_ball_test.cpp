#include "inner_ball.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "osteon/base/random.h"
#include "osteon/hull/hull.h"
#include "predicates.h"

namespace osteon::hull {
namespace {

std::vector<Vec3> in_ball(std::size_t n, std::uint64_t seed, const Vec3& axes, const Vec3& centre) {
  Random random(seed);
  std::vector<Vec3> points;
  for (std::size_t i = 0; i < n; ++i) {
    const double radius = std::cbrt(random.uniform());
    points.push_back(centre + (radius * random.direction()).cwiseProduct(axes));
  }
  return points;
}

// Independent of the filter: what it drops must be strictly inside the hull of what it keeps.
void expect_dropped_lie_inside(const std::vector<Vec3>& points,
                               const std::vector<std::uint32_t>& kept) {
  const std::set<std::uint32_t> is_kept(kept.begin(), kept.end());
  std::vector<Vec3> rest;
  for (const std::uint32_t i : kept) rest.push_back(points[i]);
  const auto outcome = build_hull(rest);
  ASSERT_TRUE(outcome.hull);
  for (std::uint32_t i = 0; i < points.size(); ++i) {
    if (is_kept.contains(i)) continue;
    for (const Triangle& t : outcome.hull->triangles) {
      const auto& v = outcome.hull->vertices;
      ASSERT_LT(orient3d(v[t[0]], v[t[1]], v[t[2]], points[i]), 0) << "point " << i;
    }
  }
}

TEST(InnerBall, SmallCloudsStayWhole) {
  const auto points = in_ball(100, 1, Vec3::Ones(), Vec3::Zero());
  EXPECT_EQ(outside_inner_ball(points).size(), 100u);
  EXPECT_TRUE(outside_inner_ball({}).empty());
}

TEST(InnerBall, FlatLineAndPointCloudsStayWhole) {
  for (const Vec3& axes : {Vec3(1, 1, 0), Vec3(1, 0, 0), Vec3(0, 0, 0)}) {
    const auto points = in_ball(3000, 2, axes, Vec3(1, 2, 3));
    EXPECT_EQ(outside_inner_ball(points).size(), points.size()) << axes.transpose();
  }
}

TEST(InnerBall, ExtremeScalesNeverLoseACorner) {
  for (const double scale : {1e-300, 1e-12, 1e6, 1e200, std::numeric_limits<double>::max() / 4}) {
    auto points = in_ball(3000, 3, Vec3::Ones(), Vec3::Zero());
    const auto plain = build_hull(points);
    for (Vec3& p : points) p *= scale;
    const auto kept = outside_inner_ball(points);
    for (const std::uint32_t s : plain.hull->source)
      EXPECT_TRUE(std::binary_search(kept.begin(), kept.end(), s)) << scale;
  }
}

TEST(InnerBall, DropsMostOfABallAndOnlyWhatLiesInside) {
  const auto points = in_ball(20000, 4, Vec3(0.03, 0.01, 0.002), Vec3(5, -3, 1));
  const auto kept = outside_inner_ball(points);
  EXPECT_LT(kept.size(), points.size() / 3);
  EXPECT_TRUE(std::is_sorted(kept.begin(), kept.end()));
  expect_dropped_lie_inside(points, kept);
}

TEST(InnerBall, AShellWithADentKeepsItsCorners) {
  // All on a sphere but for a cap cut off: the ball must not reach over the cut.
  Random random(5);
  std::vector<Vec3> points;
  while (points.size() < 5000) {
    const Vec3 p = random.direction();
    if (p.x() < 0.2) points.push_back(p);
  }
  for (int i = 0; i < 5000; ++i) points.push_back(0.1 * random.direction());
  const auto kept = outside_inner_ball(points);
  EXPECT_GE(kept.size(), 5000u);
  expect_dropped_lie_inside(points, kept);
}

}  // namespace
}  // namespace osteon::hull
