#include "bone/largest_piece.h"

#include <gtest/gtest.h>

#include <cstdint>

namespace osteon {
namespace {

/// A fan of triangles about its own first vertex, appended to the mesh.
void add_fan(TriMesh& mesh, std::uint32_t triangles, double x) {
  const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
  for (std::uint32_t i = 0; i < triangles + 2; ++i)
    mesh.vertices.push_back(Vec3(x, i, i == 0 ? 0 : 1));
  for (std::uint32_t i = 1; i <= triangles; ++i)
    mesh.triangles.push_back({first, first + i, first + i + 1});
}

TEST(LargestPiece, OfNothingIsNothing) {
  TriMesh mesh;
  keep_largest_pieces(mesh, 1);
  EXPECT_TRUE(mesh.triangles.empty());
}

TEST(LargestPiece, AWholeMeshKeepsItsOrderAndLosesVerticesThatNothingUses) {
  TriMesh mesh;
  mesh.vertices.push_back(Vec3(9, 9, 9));
  add_fan(mesh, 4, 1);
  TriMesh expected;
  add_fan(expected, 4, 1);
  keep_largest_pieces(mesh, 1);
  EXPECT_EQ(mesh.vertices, expected.vertices);
  EXPECT_EQ(mesh.triangles, expected.triangles);
}

TEST(LargestPiece, CrumbsBeforeAndBehindItGo) {
  TriMesh mesh, expected;
  add_fan(mesh, 2, 0);
  add_fan(mesh, 5, 1);
  add_fan(mesh, 3, 2);
  add_fan(expected, 5, 1);
  keep_largest_pieces(mesh, 1);
  EXPECT_EQ(mesh.vertices, expected.vertices);
  EXPECT_EQ(mesh.triangles, expected.triangles);
}

TEST(LargestPiece, OfEqualOnesTheFirstStays) {
  TriMesh mesh;
  add_fan(mesh, 2, 0);
  add_fan(mesh, 2, 1);
  keep_largest_pieces(mesh, 1);
  ASSERT_EQ(mesh.triangles.size(), 2u);
  EXPECT_EQ(mesh.vertices[0].x(), 0);
}

TEST(LargestPiece, PiecesThatShareOneVertexAreOne) {
  TriMesh mesh;
  add_fan(mesh, 2, 0);
  add_fan(mesh, 2, 1);
  mesh.triangles.push_back({0, 4, 5});
  keep_largest_pieces(mesh, 1);
  EXPECT_EQ(mesh.triangles.size(), 5u);
}

}  // namespace
}  // namespace osteon
