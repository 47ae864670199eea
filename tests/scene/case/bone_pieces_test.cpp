#include "osteon/scene/bone_pieces.h"

#include <gtest/gtest.h>

#include <utility>

namespace osteon {
namespace {

TriMesh box(const Vec3& half) {
  TriMesh mesh;
  for (int i = 0; i < 8; ++i)
    mesh.vertices.emplace_back(i & 1 ? half.x() : -half.x(), i & 2 ? half.y() : -half.y(),
                               i & 4 ? half.z() : -half.z());
  mesh.triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                    {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  return mesh;
}

DecomposeOptions cells_of(double cell_m) {
  DecomposeOptions options;
  options.search_cell_m = cell_m;
  return options;
}

TEST(BonePieces, OfAnEmptyMeshThereAreNone) { EXPECT_FALSE(cut_into_pieces(TriMesh{})); }

TEST(BonePieces, OfAConvexMeshItIsTheOne) {
  const auto found = cut_into_pieces(box({0.01, 0.01, 0.02}));
  ASSERT_TRUE(found);
  ASSERT_EQ(found->pieces.size(), 1u);
  EXPECT_EQ(found->pieces[0].size(), 8u);
}

// Pieces kept under one key must be those that a search with these cells would find.
TEST(BonePieces, TheKeyIsOfTheCellsThatAreSearched) {
  const TriMesh brief = box({0.01, 0.01, 0.12}), tall = box({0.01, 0.01, 0.15});
  EXPECT_NE(piece_key(brief, cells_of(0.0005)), piece_key(brief, cells_of(0.0008)));
  EXPECT_EQ(piece_key(tall, cells_of(0.0005)), piece_key(tall, cells_of(0.0008)));
  EXPECT_NE(piece_key(tall, cells_of(0.0005)), piece_key(tall, cells_of(0.0015)));
}

TEST(BonePieces, TheKeyIsOfEveryVertexAndCorner) {
  const TriMesh mesh = box({0.01, 0.01, 0.02});
  TriMesh moved = mesh, turned = mesh;
  moved.vertices[7].x() += 1e-12;
  std::swap(turned.triangles[3][0], turned.triangles[3][1]);
  EXPECT_EQ(piece_key(mesh), piece_key(TriMesh(mesh)));
  EXPECT_NE(piece_key(mesh), piece_key(moved));
  EXPECT_NE(piece_key(mesh), piece_key(turned));
}

}  // namespace
}  // namespace osteon
