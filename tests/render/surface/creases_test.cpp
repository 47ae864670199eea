#include "surface/creases.h"

#include <gtest/gtest.h>

#include "../scenes.h"

namespace osteon {
namespace {

ShadedMesh plain(const Surface& s) {
  ShadedMesh mesh;
  mesh.triangles = s.triangles;
  for (std::size_t k = 0; k < s.points.size(); ++k) {
    const Eigen::Vector3f p = s.points[k].cast<float>(), n = s.normals[k].cast<float>();
    mesh.positions.push_back({p.x(), p.y(), p.z()});
    mesh.normals.push_back({n.x(), n.y(), n.z()});
    mesh.shades.push_back({255, 128, 128, 128});
  }
  return mesh;
}

Vec3 vec(const std::array<float, 3>& v) { return {v[0], v[1], v[2]}; }

TEST(Creases, OfNothingAndOfABallThereAreNone) {
  ShadedMesh nothing;
  split_creases({}, nothing);
  EXPECT_TRUE(nothing.positions.empty());
  const Surface ball = make_surface(sphere_mesh(0.005));
  ShadedMesh mesh = plain(ball);
  const ShadedMesh before = mesh;
  split_creases(ball, mesh);
  EXPECT_EQ(mesh.positions, before.positions);
  EXPECT_EQ(mesh.normals, before.normals);
  EXPECT_EQ(mesh.triangles, before.triangles);
}

// Each side of a cube is flat up to its edges; where its triangles are does not change.
TEST(Creases, EachSideOfACubeHasItsOwnNormals) {
  TriMesh cube;
  for (int c = 0; c < 8; ++c)
    cube.vertices.push_back(0.005 * Vec3(c & 1 ? 1 : -1, c & 2 ? 1 : -1, c & 4 ? 1 : -1));
  cube.triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                    {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  const Surface s = make_surface(cube);
  ShadedMesh mesh = plain(s);
  split_creases(s, mesh);
  EXPECT_EQ(mesh.positions.size(), 24u);
  EXPECT_EQ(mesh.shades.size(), 24u);
  ASSERT_EQ(mesh.triangles.size(), 12u);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    std::array<Vec3, 3> p;
    for (std::size_t k = 0; k < 3; ++k) {
      p[k] = vec(mesh.positions[mesh.triangles[t][k]]);
      EXPECT_LT((p[k] - s.points[s.triangles[t][k]]).norm(), 1e-9);
    }
    const Vec3 face = (p[1] - p[0]).cross(p[2] - p[0]).normalized();
    for (std::size_t k = 0; k < 3; ++k)
      EXPECT_LT((vec(mesh.normals[mesh.triangles[t][k]]) - face).norm(), 1e-6);
  }
}

}  // namespace
}  // namespace osteon
