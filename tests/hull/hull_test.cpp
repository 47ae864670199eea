#include "osteon/hull/hull.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <set>

#include "osteon/hull/validate.h"
#include "shapes.h"

namespace osteon {
namespace {

using test::Points;
using Key = std::array<double, 3>;

std::set<Key> keys(const Points& points) {
  std::set<Key> result;
  for (const Vec3& p : points) result.insert({p.x(), p.y(), p.z()});
  return result;
}

double size_of(const Points& points) {
  Aabb box;
  for (const Vec3& p : points) box.include(p);
  return std::max(
      {box.extent().maxCoeff(), box.lo.cwiseAbs().maxCoeff(), box.hi.cwiseAbs().maxCoeff()});
}

/// Builds and validates; the stages' counts must add up.
Hull sound_hull(const Points& points) {
  HullStats stats;
  const HullOutcome outcome = build_hull(points, &stats);
  EXPECT_TRUE(outcome.hull) << describe(outcome.failure);
  if (!outcome.hull) return {};
  for (const std::string& problem : validate_hull(*outcome.hull, points, 1e-12 * size_of(points))) {
    ADD_FAILURE() << problem;
  }
  EXPECT_EQ(stats.input_points, points.size());
  EXPECT_EQ(stats.duplicates + stats.discarded_by_quickhull + stats.given_to_wrapping,
            points.size());
  EXPECT_EQ(stats.given_to_wrapping - stats.discarded_by_wrapping, outcome.hull->vertices.size());
  return *outcome.hull;
}

HullFailure failure_of(const Points& points) {
  const HullOutcome outcome = build_hull(points);
  EXPECT_FALSE(outcome.hull);
  return outcome.failure;
}

long long det(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  std::array<long long, 3> u{}, v{}, w{};
  for (int k = 0; k < 3; ++k) {
    const auto i = static_cast<std::size_t>(k);
    u[i] = static_cast<long long>(b[k] - a[k]);
    v[i] = static_cast<long long>(c[k] - a[k]);
    w[i] = static_cast<long long>(d[k] - a[k]);
  }
  return (u[1] * v[2] - u[2] * v[1]) * w[0] + (u[2] * v[0] - u[0] * v[2]) * w[1] +
         (u[0] * v[1] - u[1] * v[0]) * w[2];
}

/// Whether p is strictly between two of the points, or in the triangle of three of them without
/// being one: then it is no corner although a plane through it supports the set.
bool spanned(const Points& coplanar, const Vec3& p) {
  for (const Vec3& a : coplanar) {
    for (const Vec3& b : coplanar) {
      if (a == p || b == p || a == b) continue;
      const Vec3 u = a - p, v = b - p;
      if (u.cross(v) == Vec3::Zero() && u.dot(v) < 0) return true;
      for (const Vec3& c : coplanar) {
        if (c == p || c == a || c == b) continue;
        const Vec3 w = c - p;
        const Vec3 n = u.cross(v);
        if (n == Vec3::Zero()) continue;
        if (n.dot(v.cross(w)) > 0 && n.dot(w.cross(u)) > 0) return true;
      }
    }
  }
  return false;
}

/// Corners of the hull of few small-integer points, by trying every plane through three of them in
/// integer arithmetic.
std::set<Key> corners_by_trying(const Points& given) {
  Points points;
  for (const Key& k : keys(given)) points.emplace_back(k[0], k[1], k[2]);
  std::set<Key> corners;
  for (std::size_t i = 0; i < points.size(); ++i) {
    for (std::size_t j = 0; j < points.size(); ++j) {
      for (std::size_t k = 0; k < j; ++k) {
        if (i == j || i == k || (points[j] - points[i]).cross(points[k] - points[i]).isZero()) {
          continue;
        }
        Points coplanar;
        bool above = false, below = false;
        for (const Vec3& p : points) {
          const long long d = det(points[i], points[j], points[k], p);
          above = above || d > 0;
          below = below || d < 0;
          if (d == 0) coplanar.push_back(p);
        }
        const bool supports = above != below;
        if (supports && !spanned(coplanar, points[i])) {
          corners.insert({points[i].x(), points[i].y(), points[i].z()});
        }
      }
    }
  }
  return corners;
}

TEST(HullFailure, TooFewPoints) {
  Points points;
  for (int n = 0; n < 4; ++n) {
    EXPECT_EQ(failure_of(points), HullFailure::kTooFewPoints);
    points.emplace_back(n, n * n, 1);
  }
}

TEST(HullFailure, NotFinite) {
  for (const double bad :
       {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(),
        -std::numeric_limits<double>::infinity()}) {
    for (int k = 0; k < 3; ++k) {
      Points points = test::box_corners();
      points[5][k] = bad;
      EXPECT_EQ(failure_of(points), HullFailure::kNotFinite);
    }
  }
}

TEST(HullFailure, AllAtOnePoint) {
  EXPECT_EQ(failure_of(Points(10, Vec3(0.1, -0.2, 0.3))), HullFailure::kAllAtOnePoint);
  Points zeros(4, Vec3(0.0, 0.0, 0.0));
  zeros[2] = Vec3(-0.0, 0.0, -0.0);
  EXPECT_EQ(failure_of(zeros), HullFailure::kAllAtOnePoint);
}

TEST(HullFailure, AllOnALine) {
  Points points;
  for (int i = 0; i < 20; ++i) points.emplace_back(i % 7, 3 * (i % 7), -2 * (i % 7));
  EXPECT_EQ(failure_of(points), HullFailure::kAllOnALine);
  EXPECT_EQ(failure_of({{0, 0, 0}, {0, 0, 0}, {0, 0, 1}, {0, 0, 1}}), HullFailure::kAllOnALine);
}

TEST(HullFailure, AllInAPlane) {
  EXPECT_EQ(failure_of(test::lattice_circle()), HullFailure::kAllInAPlane);
  Points tilted;
  for (const Vec3& p : test::lattice_circle()) tilted.emplace_back(p.x(), p.y(), p.x() - 3 * p.y());
  EXPECT_EQ(failure_of(tilted), HullFailure::kAllInAPlane);
}

TEST(HullFailure, OneBitOffThePlaneIsAHull) {
  Points points = test::lattice_circle();
  points.emplace_back(0, 0, std::numeric_limits<double>::min());
  const HullOutcome outcome = build_hull(points);
  ASSERT_TRUE(outcome.hull);
  EXPECT_EQ(outcome.hull->vertices.size(), points.size());
}

TEST(HullFailure, EveryFailureHasItsOwnWords) {
  std::set<std::string_view> words;
  for (const HullFailure f :
       {HullFailure::kTooFewPoints, HullFailure::kNotFinite, HullFailure::kAllAtOnePoint,
        HullFailure::kAllOnALine, HullFailure::kAllInAPlane}) {
    words.insert(describe(f));
  }
  EXPECT_EQ(words.size(), 5u);
}

TEST(HullDegenerate, Tetrahedron) {
  const Hull hull = sound_hull({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}});
  EXPECT_EQ(hull.vertices.size(), 4u);
  EXPECT_EQ(hull.planes.size(), 4u);
  EXPECT_DOUBLE_EQ(hull.volume, 1.0 / 6);
  EXPECT_TRUE(hull.centroid.isApprox(Vec3::Constant(0.25)));
}

TEST(HullDegenerate, CubeWithPointsOnFacesEdgesAndInside) {
  for (int n = 2; n <= 9; ++n) {
    const Hull hull = sound_hull(test::lattice(n));
    EXPECT_EQ(hull.vertices.size(), 8u);
    EXPECT_EQ(hull.planes.size(), 6u);
    EXPECT_EQ(hull.triangles.size(), 12u);
    EXPECT_DOUBLE_EQ(hull.volume, (n - 1.0) * (n - 1) * (n - 1));
  }
}

TEST(HullDegenerate, CopiesOfEveryPoint) {
  Points points;
  for (int copy = 0; copy < 6; ++copy) {
    for (const Vec3& p : test::lattice_sphere(230)) points.push_back(p);
  }
  const Hull hull = sound_hull(points);
  EXPECT_EQ(keys(hull.vertices), keys(points));
}

TEST(HullDegenerate, PrismOfCocircularCaps) {
  Points points;
  for (const Vec3& p : test::lattice_circle()) {
    for (int z = 0; z < 5; ++z) points.emplace_back(p.x(), p.y(), 10 * z);
  }
  const Hull hull = sound_hull(points);
  EXPECT_EQ(hull.vertices.size(), 72u);
  EXPECT_EQ(hull.planes.size(), 38u);
}

/// Sides of a cylinder: each a rectangle with points on its upright edges; caps with 500 corners.
TEST(HullDegenerate, CylinderOfRectangles) {
  Points points;
  for (int i = 0; i < 500; ++i) {
    const double angle = i * 2 * 3.14159265358979 / 500;
    for (int z = 0; z < 4; ++z) points.emplace_back(std::cos(angle), std::sin(angle), z);
  }
  const Hull hull = sound_hull(points);
  EXPECT_EQ(hull.vertices.size(), 1000u);
  EXPECT_EQ(hull.planes.size(), 502u);
}

/// Every point lies exactly on a plane of the hull.
TEST(HullDegenerate, SquarePyramidFullOfPointsOnItsFaces) {
  Random random(12);
  Points points = {{-1, -1, 1}, {1, -1, 1}, {1, 1, 1}, {-1, 1, 1}, {0, 0, 0}};
  for (int i = 0; i < 3000; ++i) {
    const double x = random.uniform(-1, 1), y = random.uniform(-1, 1);
    points.emplace_back(x, y, std::max(std::abs(x), std::abs(y)));
  }
  const Hull hull = sound_hull(points);
  EXPECT_EQ(hull.vertices.size(), 5u);
  EXPECT_EQ(hull.planes.size(), 5u);
}

TEST(HullDegenerate, SpheresWithCocircularFacets) {
  for (const int r2 : {41, 101, 306}) {
    const Points points = test::lattice_sphere(r2);
    const Hull hull = sound_hull(points);
    EXPECT_EQ(keys(hull.vertices), keys(points)) << r2;
    EXPECT_LT(hull.planes.size(), hull.triangles.size()) << r2;
  }
}

TEST(HullDegenerate, FlattenedByOneBit) {
  Random random(3);
  Points points;
  for (int i = 0; i < 300; ++i) {
    const Vec3 p = random.direction();
    points.emplace_back(p.x(), p.y(), 1 + 0x1p-52 * static_cast<double>(random.next() % 2));
  }
  sound_hull(points);
}

TEST(HullDegenerate, NeedleOfSixteenDecades) {
  Points points;
  for (const Vec3& p : test::lattice_sphere(41))
    points.emplace_back(p.x(), 1e-8 * p.y(), 1e8 * p.z());
  EXPECT_TRUE(build_hull(points).hull);
  EXPECT_EQ(keys(build_hull(points).hull->vertices), keys(points));
}

TEST(HullDegenerate, ExtremesOfDoubles) {
  for (const double s : {1e-300, 1e-160, 1e-100, 1e100, 1e160, 1e300}) {
    Points points;
    for (const Vec3& p : test::lattice(3)) points.push_back(s * p);
    const HullOutcome outcome = build_hull(points);
    ASSERT_TRUE(outcome.hull) << s;
    EXPECT_EQ(outcome.hull->vertices.size(), 8u) << s;
    EXPECT_EQ(outcome.hull->planes.size(), 6u) << s;
  }
  Points mixed = {{1e300, 0, 0}, {0, 1e-300, 0}, {0, 0, 1}, {0, 0, 0}, {0, 1e-301, 0}};
  ASSERT_TRUE(build_hull(mixed).hull);
  EXPECT_EQ(build_hull(mixed).hull->vertices.size(), 4u);
}

TEST(HullDegenerate, SameAtEveryScaleAndPlace) {
  for (const double s : {0x1p-40, 0x1p-20, 1.0, 0x1p20}) {
    for (const double offset : {0.0, 0x1p10, 0x1p30}) {
      Points points;
      for (const Vec3& p : test::lattice_sphere(230)) {
        points.push_back(s * (p + Vec3(offset, -offset, 3 * offset)));
      }
      const Hull hull = sound_hull(points);
      EXPECT_EQ(hull.vertices.size(), points.size());
      EXPECT_EQ(hull.planes.size(), sound_hull(test::lattice_sphere(230)).planes.size());
    }
  }
}

TEST(HullOracle, SmallIntegerPoints) {
  Random random(11);
  for (int trial = 0; trial < 400; ++trial) {
    const std::size_t n = 4 + random.next() % 20;
    const int range = 2 + static_cast<int>(random.next() % 5);
    const Points points = test::integer_points(random, n, range);
    const HullOutcome outcome = build_hull(points);
    const std::set<Key> corners = corners_by_trying(points);
    ASSERT_EQ(outcome.hull.has_value(), !corners.empty()) << trial;
    if (!outcome.hull) continue;
    EXPECT_EQ(keys(outcome.hull->vertices), corners) << trial;
    EXPECT_TRUE(validate_hull(*outcome.hull, points, 1e-12).empty()) << trial;
  }
}

TEST(Hull, SphereKeepsEveryPoint) {
  Random random(5);
  const Points points = test::sphere(random, 4000);
  EXPECT_EQ(sound_hull(points).vertices.size(), points.size());
}

TEST(Hull, BothStagesWork) {
  Random random(6);
  HullStats stats;
  const HullOutcome outcome = build_hull(test::ball(random, 20000), &stats);
  ASSERT_TRUE(outcome.hull);
  EXPECT_GT(stats.discarded_by_quickhull, 15000u);
  EXPECT_GT(stats.discarded_by_wrapping, 0u);
  EXPECT_LT(stats.discarded_by_wrapping, 2000u);
}

TEST(Hull, OrderOfTheInputDoesNotMatter) {
  Random random(7);
  Points points = test::ball(random, 3000);
  for (const Vec3& p : test::lattice(4)) points.push_back(0.5 * p);
  const Hull first = sound_hull(points);
  for (int trial = 0; trial < 5; ++trial) {
    test::shuffle(random, points);
    const Hull again = sound_hull(points);
    EXPECT_EQ(keys(again.vertices), keys(first.vertices));
    EXPECT_EQ(again.planes.size(), first.planes.size());
  }
}

TEST(Hull, SameInputSameResult) {
  Random random(8);
  const Points points = test::ball(random, 3000);
  const Hull a = sound_hull(points);
  const Hull b = sound_hull(points);
  EXPECT_EQ(a.source, b.source);
  EXPECT_EQ(a.triangles, b.triangles);
  EXPECT_EQ(a.volume, b.volume);
}

TEST(Hull, MeshIsTheHullsSurface) {
  const Hull hull = sound_hull(test::box_corners());
  const TriMesh mesh = to_mesh(hull);
  EXPECT_EQ(mesh.vertices.size(), 8u);
  EXPECT_EQ(mesh.triangles, hull.triangles);
}

}  // namespace
}  // namespace osteon
