#include "osteon/mesh/tet_mesh.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "mesh/surface_checks.h"

namespace osteon {
namespace {

TetMesh regular() {
  TetMesh mesh;
  mesh.vertices = {Vec3(1, 1, 1), Vec3(-1, 1, -1), Vec3(1, -1, -1), Vec3(-1, -1, 1)};
  mesh.tets = {{0, 1, 2, 3}};
  return mesh;
}

TEST(TetMesh, AnEmptyMeshHasNothing) {
  EXPECT_EQ(volume(TetMesh{}), 0);
  EXPECT_TRUE(boundary(TetMesh{}).surface.triangles.empty());
  EXPECT_EQ(quality(TetMesh{}).min_dihedral_rad, 0);
}

TEST(TetMesh, ARegularElementHasItsClosedForm) {
  const TetMesh mesh = regular();
  EXPECT_NEAR(volume(mesh), 8.0 / 3, 1e-15);
  for (const double angle : dihedral_angles(corners_of(mesh, mesh.tets[0])))
    EXPECT_NEAR(angle, std::acos(1.0 / 3), 1e-15);
  const TetQuality q = quality(mesh);
  EXPECT_EQ(q.histogram[7], 6u);  // 70.53 degrees
  EXPECT_NEAR(q.mean_smallest_rad, std::acos(1.0 / 3), 1e-15);
  EXPECT_EQ(q.inverted, 0u);
  const TetBoundary shell = boundary(mesh);
  EXPECT_TRUE(checks::is_closed_manifold(shell.surface));
  EXPECT_NEAR(checks::signed_volume(shell.surface), 8.0 / 3, 1e-15);
}

TEST(TetMesh, TheEdgesOfACornerOfACubeAreKnown) {
  const std::array<Vec3, 4> corner{Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1)};
  const std::array<double, 6> angle = dihedral_angles(corner);
  for (std::size_t e = 0; e < 3; ++e) EXPECT_NEAR(angle[e], M_PI / 2, 1e-15);
  for (std::size_t e = 3; e < 6; ++e) EXPECT_NEAR(angle[e], std::acos(std::sqrt(1.0 / 3)), 1e-15);
}

TEST(TetMesh, FlatAndTurnedElementsCountAsInverted) {
  TetMesh mesh = regular();
  mesh.tets.push_back({0, 1, 3, 2});
  mesh.vertices.push_back(0.5 * (mesh.vertices[0] + mesh.vertices[1]));
  mesh.tets.push_back({0, 1, 2, 4});
  EXPECT_EQ(quality(mesh).inverted, 2u);
}

TEST(TetMesh, ASharedFaceIsNotOfTheBoundary) {
  TetMesh mesh = regular();
  mesh.vertices.emplace_back(-5, -5, -5);
  mesh.vertices.emplace_back(1, 1, 1);  // of no element
  mesh.tets.push_back({2, 1, 4, 3});
  if (signed_volume(corners_of(mesh, mesh.tets[1])) < 0)
    std::swap(mesh.tets[1][0], mesh.tets[1][1]);
  const TetBoundary shell = boundary(mesh);
  EXPECT_EQ(shell.surface.triangles.size(), 6u);
  EXPECT_EQ(shell.surface.vertices.size(), 5u);
  EXPECT_EQ(shell.tet_of, (std::vector<std::uint32_t>{0, 0, 0, 1, 1, 1}));
  EXPECT_TRUE(checks::is_closed_manifold(shell.surface));
  EXPECT_NEAR(checks::signed_volume(shell.surface), volume(mesh), 1e-12);
  const TetQuality q = quality(mesh);
  EXPECT_EQ(std::accumulate(q.histogram.begin(), q.histogram.end(), std::size_t{0}), 12u);
}

}  // namespace
}  // namespace osteon
