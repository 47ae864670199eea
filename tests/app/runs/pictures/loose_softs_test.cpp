#include "runs/pictures/loose_softs.h"

#include <gtest/gtest.h>

#include <cmath>

#include "osteon/carve/piece_shape.h"
#include "osteon/mesh/measure.h"

namespace osteon {
namespace {

// A ball about `middle` on a bone.
std::shared_ptr<const PieceShape> loose_ball(double radius_m, const Vec3& middle) {
  PieceGrid grid;
  grid.bone = 2;
  grid.cell_m = 0.00015;
  const int n = static_cast<int>(std::ceil(2 * radius_m / grid.cell_m)) + 5;
  grid.nodes = {n, n, n};
  grid.lo_B = middle - 0.5 * (n - 1) * grid.cell_m * Vec3::Ones();
  for (int z = 0; z < n; ++z)
    for (int y = 0; y < n; ++y)
      for (int x = 0; x < n; ++x) {
        const Vec3 p = grid.lo_B + grid.cell_m * Vec3(x, y, z);
        grid.heights.push_back(
            static_cast<std::int16_t>(std::lround(1e6 * ((p - middle).norm() - radius_m))));
      }
  return PieceShape::from(std::move(grid));
}

TEST(LooseSofts, WithoutPiecesThereAreNone) {
  LooseSofts loose;
  EXPECT_TRUE(loose.new_pieces({}).empty());
  SoftPushes pushes;
  pushes.piece_count = 1;  // of which nothing is known
  EXPECT_TRUE(loose.new_pieces(pushes).empty());
  pushes.piece_count = 1000;
  EXPECT_TRUE(loose.new_pieces(pushes).empty());
}

TEST(LooseSofts, EachIsGivenOnceWithItsClosedSurface) {
  const auto first = loose_ball(0.002, Vec3(0.01, 0, 0));
  const auto second = loose_ball(0.0015, Vec3::Zero());
  ASSERT_TRUE(first && second);
  LooseSofts loose;
  SoftPushes pushes;
  pushes.pieces[pushes.piece_count++] = first;
  const auto given = loose.new_pieces(pushes);
  ASSERT_EQ(given.size(), 1u);
  EXPECT_EQ(given[0].shape, first->hash());
  EXPECT_EQ(given[0].bone, 2u);
  const SurfaceCube& surface = given[0].surface;
  EXPECT_EQ(surface.normals.size(), surface.vertices.size());
  const TriMesh mesh{surface.vertices, surface.triangles};
  EXPECT_TRUE(topology(mesh).closed());
  const double ball_m3 = 4 * M_PI / 3 * 8e-9;
  EXPECT_NEAR(volume(mesh), ball_m3, 0.01 * ball_m3);
  EXPECT_TRUE(loose.new_pieces(pushes).empty());
  pushes.pieces[pushes.piece_count++] = second;
  ASSERT_EQ(loose.new_pieces(pushes).size(), 1u);
  EXPECT_TRUE(LooseSofts(loose).new_pieces(pushes).empty());
  EXPECT_EQ(LooseSofts().new_pieces(pushes).size(), 2u);
}

}  // namespace
}  // namespace osteon
