// How hulls stand over a mesh. What is remembered of facets must not change what is found.
#include "excess.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "osteon/base/random.h"
#include "osteon/mesh/isosurface.h"

namespace osteon::hull {
namespace {

constexpr double kCell_m = 0.0005;

// A ball that a second one has hollowed: the hull's lid stands over the hollow.
TriMesh cup() {
  IsosurfaceOptions options;
  options.cell_m = 0.0008;
  return std::move(*isosurface(
      [](const Vec3& p) {
        return std::max(p.norm() - 0.008, 0.007 - (p - Vec3(0, 0, 0.008)).norm());
      },
      {Vec3::Constant(-0.0095), Vec3::Constant(0.0095)}, options));
}

Hull hull_below(const TriMesh& mesh, const Plane& plane) {
  std::vector<Vec3> points;
  for (const Vec3& v : mesh.vertices)
    if (plane.signed_distance(v) <= 0) points.push_back(v);
  return *build_hull(points).hull;
}

struct Bench {
  explicit Bench(const TriMesh& mesh)
      : grid(mesh, kCell_m), meter(grid, {JointEnds(mesh), 1}, kCell_m) {}
  HeightGrid grid;
  ExcessMeter meter;
};

void expect_same(const Excess& a, const Excess& b) {
  EXPECT_EQ(a.peak.need, b.peak.need);
  EXPECT_EQ(a.peak.height, b.peak.height);
  EXPECT_EQ(a.peak.at, b.peak.at);
  EXPECT_EQ(a.moment, b.moment);
}

TEST(ExcessMeter, FindsTheSameWithAndWithoutWhatItRemembers) {
  const TriMesh mesh = cup();
  Bench used(mesh);
  Random random(31);
  for (int i = 0; i < 12; ++i) {
    const Vec3 n = random.direction();
    const Hull hull = hull_below(mesh, {n, random.uniform(-0.001, 0.006)});
    Bench fresh(mesh);
    const Excess sampled = used.meter.sampled(hull);
    expect_same(sampled, fresh.meter.sampled(hull));
    expect_same(used.meter.exact(hull, sampled, 0.0001, 1e300),
                fresh.meter.exact(hull, sampled, 0.0001, 1e300));
    const auto all = used.meter.moment_below(hull, 0, 1e300);
    ASSERT_TRUE(all);
    EXPECT_EQ(all, fresh.meter.moment_below(hull, 0, 1e300));
    EXPECT_FALSE(used.meter.moment_below(hull, 0, *all));
    EXPECT_EQ(used.meter.moment_below(hull, 0, std::nextafter(*all, 1)), all);
  }
}

// Oracle: the distance at a great many places of every facet.
TEST(ExcessMeter, NoPlaceOfTheHullStandsHigherThanThePeakAllows) {
  const TriMesh mesh = cup();
  const Hull hull = *build_hull(mesh.vertices).hull;
  Bench bench(mesh);
  const Excess found = bench.meter.exact(hull, bench.meter.sampled(hull), 0, 1e300);
  const MeshDistance distance(mesh);
  EXPECT_NEAR(distance.closest(found.peak.at).signed_distance, found.peak.height, 1e-15);
  const double allowed = found.peak.need + std::max(kPeakError_m, 0.05 * found.peak.need);
  Random random(32);
  double highest = 0;
  for (const Triangle& t : hull.triangles)
    for (int i = 0; i < 40; ++i) {
      const double u = std::sqrt(random.uniform(0, 1));
      const double w = random.uniform(0, 1);
      const Vec3& a = hull.vertices[t[0]];
      const Vec3 p =
          a + u * (1 - w) * (hull.vertices[t[1]] - a) + u * w * (hull.vertices[t[2]] - a);
      highest = std::max(highest, distance.closest(p).signed_distance);
    }
  EXPECT_LE(highest, allowed);
  EXPECT_GT(highest, 0.9 * found.peak.height);
}

}  // namespace
}  // namespace osteon::hull
