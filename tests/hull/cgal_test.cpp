// The vertex sets of exact convex hulls by CGAL, on random points and on the wrist's bones.

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/convex_hull_3.h>
#include <gtest/gtest.h>

#include <array>
#include <cstdlib>
#include <filesystem>
#include <set>

#include "osteon/hull/hull.h"
#include "osteon/hull/validate.h"
#include "osteon/mesh/mesh_io.h"
#include "shapes.h"

namespace osteon {
namespace {

using test::Points;
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Key = std::array<double, 3>;

std::set<Key> cgal_vertices(const Points& points) {
  std::vector<Kernel::Point_3> input;
  for (const Vec3& p : points) input.emplace_back(p.x(), p.y(), p.z());
  CGAL::Surface_mesh<Kernel::Point_3> mesh;
  CGAL::convex_hull_3(input.begin(), input.end(), mesh);
  std::set<Key> vertices;
  for (const auto& p : mesh.points()) vertices.insert({p.x(), p.y(), p.z()});
  return vertices;
}

std::set<Key> our_vertices(const Hull& hull) {
  std::set<Key> vertices;
  for (const Vec3& v : hull.vertices) vertices.insert({v.x(), v.y(), v.z()});
  return vertices;
}

void expect_same(const Points& points) {
  const HullOutcome outcome = build_hull(points);
  ASSERT_TRUE(outcome.hull) << describe(outcome.failure);
  EXPECT_EQ(our_vertices(*outcome.hull), cgal_vertices(points));
}

TEST(HullBesideCgal, Balls) {
  Random random(21);
  for (const std::size_t n : {5u, 10u, 50u, 500u, 5000u, 50000u})
    expect_same(test::ball(random, n));
}

TEST(HullBesideCgal, Spheres) {
  Random random(22);
  for (const std::size_t n : {5u, 20u, 300u, 10000u}) expect_same(test::sphere(random, n));
}

/// Rounded to a grid as fine as a float, so that nearly coplanar and equal points abound.
TEST(HullBesideCgal, SpheresOnAFineGrid) {
  Random random(23);
  for (const double cell : {0x1p-24, 0x1p-14, 0x1p-10}) {
    Points points = test::sphere(random, 5000);
    for (Vec3& p : points) {
      for (int k = 0; k < 3; ++k) p[k] = cell * std::round(p[k] / cell);
    }
    expect_same(points);
  }
}

TEST(HullBesideCgal, FarFromTheOriginAndSmall) {
  Random random(24);
  for (const double size : {1e-6, 1e-3, 1.0}) {
    Points points = test::ball(random, 6000);
    for (Vec3& p : points) p = size * p + Vec3(1e3, -2e5, 3e4);
    expect_same(points);
  }
}

TEST(HullBesideCgal, FlatAndLongBalls) {
  Random random(25);
  for (const double s : {1e-12, 1e-6, 1e6}) {
    Points points = test::ball(random, 6000);
    for (Vec3& p : points) p.z() *= s;
    expect_same(points);
  }
}

/// As thin as rounding: nearly every test is left to exact arithmetic.
TEST(HullBesideCgal, TiltedDiscs) {
  Random random(26);
  const Quat tilt = Quat(0.3, 0.5, -0.2, 0.7).normalized();
  for (const double thickness : {0.0, 1e-16, 1e-14, 1e-12}) {
    Points points = test::ball(random, 800);
    for (Vec3& p : points) {
      p.z() *= thickness;
      p = tilt * p;
    }
    expect_same(points);
  }
}

/// Long thin facets, nearly flat along the curve (t, t^2, t^3).
TEST(HullBesideCgal, MomentCurve) {
  Random random(27);
  Points points;
  for (int i = 0; i < 2000; ++i) {
    const double t = random.uniform();
    points.emplace_back(t, t * t, t * t * t);
  }
  expect_same(points);
}

/// Points strewn over triangles lie in their planes but for rounding.
TEST(HullBesideCgal, PointsOverFlatFaces) {
  Random random(28);
  const Points corners = test::sphere(random, 12);
  Points points;
  for (int i = 0; i < 6000; ++i) {
    const double u = random.uniform(), v = random.uniform();
    const std::size_t k = random.next() % 10;
    points.push_back((1 - u) * corners[k] + u * (1 - v) * corners[k + 1] + u * v * corners[k + 2]);
  }
  expect_same(points);
}

std::filesystem::path wrist_folder() {
  const char* shared = std::getenv("OSTEON_SHARED");
  return std::filesystem::path(shared ? shared : OSTEON_SOURCE_DIR "/../shared") / "anatomy/wrist";
}

TEST(HullBesideCgal, FifteenWristBones) {
  if (!std::filesystem::exists(wrist_folder())) {
    GTEST_SKIP() << "no wrist meshes; OSTEON_SHARED names the folder that holds anatomy/wrist";
  }
  int bones = 0;
  for (const auto& entry : std::filesystem::directory_iterator(wrist_folder())) {
    if (entry.path().extension() != ".stl") continue;
    SCOPED_TRACE(entry.path().filename());
    const Result<TriMesh> mesh = load_mesh(entry.path(), 1.0);
    ASSERT_TRUE(mesh) << mesh.error().message();
    const HullOutcome outcome = build_hull(mesh->vertices);
    ASSERT_TRUE(outcome.hull);
    EXPECT_EQ(our_vertices(*outcome.hull), cgal_vertices(mesh->vertices));
    EXPECT_EQ(validate_hull(*outcome.hull, mesh->vertices), std::vector<std::string>{});
    ++bones;
  }
  EXPECT_EQ(bones, 15);
}

}  // namespace
}  // namespace osteon
