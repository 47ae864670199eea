#include "osteon/mesh/measure.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "mesh/shapes.h"
#include "osteon/base/random.h"

namespace osteon {
namespace {

using test::cube;
using test::sphere;

TEST(Measure, EmptyMeshHasNothing) {
  const TriMesh none;
  EXPECT_TRUE(bounds(none).empty());
  EXPECT_EQ(volume(none), 0);
  EXPECT_EQ(area(none), 0);
  EXPECT_EQ(centroid(none), Vec3(0, 0, 0));
  EXPECT_TRUE(vertex_normals(none).empty());
  EXPECT_EQ(topology(none).components, 0u);
}

TEST(Measure, DegenerateTriangleGivesFiniteNumbers) {
  TriMesh m;
  m.vertices = {Vec3(1, 2, 3), Vec3(1, 2, 3), Vec3(1, 2, 3)};
  m.triangles = {{0, 1, 2}};
  EXPECT_EQ(area(m), 0);
  EXPECT_EQ(centroid(m), Vec3(1, 2, 3));
  EXPECT_EQ(vertex_normals(m)[0], Vec3(0, 0, 1));
}

TEST(Measure, CubeFarFromTheOrigin) {
  const Vec3 c(50, -30, 20);
  const TriMesh m = cube(0.01, c);
  EXPECT_NEAR(volume(m), 8e-6, 1e-14);
  EXPECT_NEAR(area(m), 24e-4, 1e-12);
  EXPECT_LT((centroid(m) - c).norm(), 1e-10);
  EXPECT_LT((bounds(m).extent() - Vec3::Constant(0.02)).norm(), 1e-12);
}

TEST(Measure, InsideOutCubeHasNegativeVolume) {
  TriMesh m = cube();
  for (Triangle& t : m.triangles) test::flip(t);
  EXPECT_NEAR(volume(m), -1, 1e-12);
  EXPECT_TRUE(topology(m).closed());
}

TEST(Measure, SphereApproachesItsFormulas) {
  const TriMesh m = sphere(0.03, 60, Vec3(0.1, 0.2, 0.3));
  EXPECT_NEAR(volume(m) / (4 * M_PI / 3 * std::pow(0.03, 3)), 1, 3e-3);
  EXPECT_NEAR(area(m) / (4 * M_PI * 0.03 * 0.03), 1, 3e-3);
  const std::vector<Vec3> normals = vertex_normals(m);
  for (std::size_t i = 0; i < normals.size(); ++i)
    EXPECT_GT(normals[i].dot((m.vertices[i] - Vec3(0.1, 0.2, 0.3)) / 0.03), 0.999);
}

// A tetrahedron's centre of volume is the mean of its corners, its volume a determinant.
TEST(Measure, RandomTetrahedraAgreeWithTheClosedForm) {
  Random random(7);
  for (int i = 0; i < 200; ++i) {
    TriMesh m;
    for (int k = 0; k < 4; ++k) {
      const double x = random.uniform(-1, 1);
      const double y = random.uniform(-1, 1);
      const double z = random.uniform(-1, 1);
      m.vertices.emplace_back(x, y, z);
    }
    m.triangles = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}};
    Mat3 edges;
    for (int k = 0; k < 3; ++k) edges.col(k) = m.vertices[k + 1u] - m.vertices[0];
    EXPECT_NEAR(volume(m), edges.determinant() / 6, 1e-12);
    const Vec3 mean = (m.vertices[0] + m.vertices[1] + m.vertices[2] + m.vertices[3]) / 4;
    if (std::abs(volume(m)) > 1e-3) {
      EXPECT_LT((centroid(m) - mean).norm(), 1e-9);
    }
  }
}

TEST(Topology, CountsWhatIsWrong) {
  TriMesh open = cube();
  open.triangles.pop_back();
  EXPECT_EQ(topology(open).boundary_edges, 3u);
  EXPECT_FALSE(topology(open).closed());

  TriMesh turned = cube();
  test::flip(turned.triangles[0]);
  EXPECT_EQ(topology(turned).misoriented_edges, 3u);

  TriMesh fin = cube();
  fin.vertices.emplace_back(2, 2, 2);
  fin.triangles.push_back({0, 1, 8});
  EXPECT_EQ(topology(fin).non_manifold_edges, 1u);
  EXPECT_EQ(topology(fin).boundary_edges, 2u);
}

TEST(Topology, CountsComponentsByEdges) {
  EXPECT_EQ(topology(cube()).components, 1u);
  EXPECT_TRUE(topology(cube()).closed());
  EXPECT_EQ(topology(test::joined(cube(), cube(0.1))).components, 2u);
  EXPECT_EQ(topology(test::soup(cube())).components, 12u);
}

TEST(ConnectedParts, OfNothingThereAreNone) { EXPECT_TRUE(connected_parts({}).empty()); }

// Two balls and a cube that shares a corner's place, but no vertex, with nothing.
TEST(ConnectedParts, EachIsClosedAndAllTogetherAreTheMesh) {
  TriMesh all = sphere(0.01, 12);
  const auto add = [&](const TriMesh& part) {
    const auto first = static_cast<std::uint32_t>(all.vertices.size());
    all.vertices.insert(all.vertices.end(), part.vertices.begin(), part.vertices.end());
    for (const Triangle& t : part.triangles)
      all.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
  };
  add(cube(0.01, Vec3(0.05, 0, 0)));
  add(sphere(0.005, 9, Vec3(0, 0.05, 0)));
  all.vertices.emplace_back(9, 9, 9);  // of no triangle
  // Triangles of the parts in turn.
  std::reverse(all.triangles.begin() + 40, all.triangles.end());
  const auto parts = connected_parts(all);
  ASSERT_EQ(parts.size(), 3u);
  double sum = 0;
  std::size_t triangles = 0, vertices = 0;
  for (const TriMesh& part : parts) {
    EXPECT_TRUE(topology(part).closed());
    EXPECT_EQ(topology(part).components, 1u);
    sum += volume(part);
    triangles += part.triangles.size();
    vertices += part.vertices.size();
  }
  EXPECT_NEAR(sum, volume(all), 1e-12);
  EXPECT_EQ(triangles, all.triangles.size());
  EXPECT_EQ(vertices, all.vertices.size() - 1);
  EXPECT_LT(centroid(parts[0]).norm(), 1e-4);
}

// A corner that two parts share belongs to both.
TEST(ConnectedParts, TrianglesThatShareACornerAloneAreApart) {
  TriMesh mesh;
  mesh.vertices = {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(-1, 0, 0), Vec3(0, -1, 0)};
  mesh.triangles = {{0, 1, 2}, {0, 3, 4}};
  const auto parts = connected_parts(mesh);
  ASSERT_EQ(parts.size(), 2u);
  EXPECT_EQ(parts[1].vertices.size(), 3u);
  EXPECT_EQ(parts[1].vertices[0], Vec3(0, 0, 0));
}

}  // namespace
}  // namespace osteon
