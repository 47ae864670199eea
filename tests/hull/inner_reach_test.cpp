#include "inner_reach.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "cube_map.h"
#include "exact/predicates.h"
#include "osteon/base/random.h"
#include "osteon/hull/hull.h"
#include "quickhull.h"

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

/// What the first stage keeps; it drops by reach alone.
std::vector<std::uint32_t> kept_of(const std::vector<Vec3>& points) {
  const Cloud cloud(points, finite_box(points));
  return quickhull(cloud).points;
}

// Independent of the filter: what it drops must be strictly inside the hull of what it keeps.
void expect_dropped_lie_inside(const std::vector<Vec3>& points,
                               const std::vector<std::uint32_t>& kept) {
  std::vector<Vec3> rest;
  for (const std::uint32_t i : kept) rest.push_back(points[i]);
  const auto outcome = build_hull(rest);
  ASSERT_TRUE(outcome.hull);
  for (std::uint32_t i = 0; i < points.size(); ++i) {
    if (std::binary_search(kept.begin(), kept.end(), i)) continue;
    for (const Triangle& t : outcome.hull->triangles) {
      const auto& v = outcome.hull->vertices;
      ASSERT_LT(orient3d(v[t[0]], v[t[1]], v[t[2]], points[i]), 0) << "point " << i;
    }
  }
}

TEST(InnerReach, SmallCloudsStayWhole) {
  EXPECT_EQ(kept_of(in_ball(100, 1, Vec3::Ones(), Vec3::Zero())).size(), 100u);
}

TEST(InnerReach, FlatCloudsHaveNoPolytope) {
  for (const Vec3& axes : {Vec3(1, 1, 0), Vec3(1, 0, 0), Vec3(0, 0, 0)}) {
    const auto points = in_ball(6000, 2, axes, Vec3(1, 2, 3));
    const Cloud cloud(points, finite_box(points));
    EXPECT_FALSE(quickhull(cloud).polytope) << axes.transpose();
  }
}

TEST(InnerReach, ACloudThinnerThanRoundingStaysWhole) {
  const Quat tilt = Quat(0.3, 0.5, -0.2, 0.7).normalized();
  auto points = in_ball(6000, 2, Vec3(1, 1, 1e-14), Vec3::Zero());
  for (Vec3& p : points) p = tilt * p;
  EXPECT_EQ(kept_of(points).size(), points.size());
}

TEST(InnerReach, ExtremeScalesNeverLoseACorner) {
  for (const double scale : {1e-300, 1e-12, 1e6, 1e200, std::numeric_limits<double>::max() / 4}) {
    auto points = in_ball(6000, 3, Vec3::Ones(), Vec3::Zero());
    const auto plain = build_hull(points);
    for (Vec3& p : points) p *= scale;
    const auto kept = kept_of(points);
    EXPECT_LT(kept.size(), points.size()) << scale;
    for (const std::uint32_t s : plain.hull->source)
      EXPECT_TRUE(std::binary_search(kept.begin(), kept.end(), s)) << scale;
  }
}

TEST(InnerReach, DropsMostOfABallAndOnlyWhatLiesInside) {
  const auto points = in_ball(20000, 4, Vec3(0.03, 0.01, 0.002), Vec3(5, -3, 1));
  const auto kept = kept_of(points);
  EXPECT_LT(kept.size(), points.size() / 3);
  EXPECT_TRUE(std::is_sorted(kept.begin(), kept.end()));
  expect_dropped_lie_inside(points, kept);
}

TEST(InnerReach, AShellWithADentKeepsItsCorners) {
  // All on a sphere but for a cap cut off: what is dropped must not reach over the cut.
  Random random(5);
  std::vector<Vec3> points;
  while (points.size() < 5000) {
    const Vec3 p = random.direction();
    if (p.x() < 0.2) points.push_back(p);
  }
  for (int i = 0; i < 5000; ++i) points.push_back(0.1 * random.direction());
  const auto kept = kept_of(points);
  EXPECT_EQ(kept.size(), 5000u);
  expect_dropped_lie_inside(points, kept);
}

// A lattice makes ties everywhere: facets of one plane, rays through edges and corners.
TEST(InnerReach, OfALatticeOnlyTheSurfaceAndWhatIsNearItStays) {
  std::vector<Vec3> points;
  for (int x = 0; x < 24; ++x)
    for (int y = 0; y < 24; ++y)
      for (int z = 0; z < 24; ++z) points.emplace_back(x, y, z);
  const auto kept = kept_of(points);
  EXPECT_LT(kept.size(), points.size() / 2);
  for (std::uint32_t i = 0; i < points.size(); ++i) {
    const Vec3& p = points[i];
    if (p.minCoeff() > 0 && p.maxCoeff() < 23) continue;
    EXPECT_TRUE(std::binary_search(kept.begin(), kept.end(), i)) << p.transpose();
  }
}

}  // namespace
}  // namespace osteon::hull
