#include "osteon/mesh/cube_loops.h"

#include <gtest/gtest.h>

#include <bit>

namespace osteon {
namespace {

TEST(CubeLoops, NoLoopWhereAllCornersAgree) {
  EXPECT_EQ(cube_loops(0, 0).count, 0);
  EXPECT_EQ(cube_loops(255, 0).count, 0);
}

TEST(CubeLoops, EdgesJoinNeighbouringCorners) {
  for (int e = 0; e < 12; ++e) {
    const auto [a, b] = cube_edge_corners(e);
    EXPECT_EQ(b - a, 1 << e / 4);
    EXPECT_EQ(std::popcount(static_cast<unsigned>(a ^ b)), 1);
  }
}

TEST(CubeLoops, OneCornerIsCutOffByOneTriangle) {
  for (int c = 0; c < 8; ++c) {
    const CubeLoops loops = cube_loops(static_cast<std::uint8_t>(1 << c), 0);
    EXPECT_EQ(loops.count, 1);
    int crossed = 0;
    for (const int loop : loops.of_edge) crossed += loop == 0;
    EXPECT_EQ(crossed, 3);
  }
}

TEST(CubeLoops, OppositeCornersOfTheCubeStayApart) { EXPECT_EQ(cube_loops(0x81, 0).count, 2); }

TEST(CubeLoops, JoiningAFaceJoinsItsCorners) {
  const std::uint8_t corners = 1 << 0 | 1 << 3;  // opposite corners of the lower z face
  ASSERT_TRUE(face_is_ambiguous(corners, 4));
  EXPECT_EQ(cube_loops(corners, 0).count, 2);
  EXPECT_EQ(cube_loops(corners, 1 << 4).count, 1);
  EXPECT_FALSE(face_is_ambiguous(corners, 5));
}

TEST(CubeLoops, EveryCrossedEdgeHasALoopAndNoOther) {
  for (int inside = 0; inside < 256; ++inside) {
    const CubeLoops loops = cube_loops(static_cast<std::uint8_t>(inside), 0);
    for (int e = 0; e < 12; ++e) {
      const auto [a, b] = cube_edge_corners(e);
      const bool crossed = ((inside >> a ^ inside >> b) & 1) != 0;
      const int loop = loops.of_edge[static_cast<std::size_t>(e)];
      EXPECT_EQ(loop >= 0, crossed);
      EXPECT_LT(loop, loops.count);
    }
  }
}

/// The proof behind the resolution of ambiguous faces: joining a face that one loop takes twice
/// makes two loops of it.
TEST(CubeLoops, JoiningAFaceThatOneLoopTakesTwiceSplitsTheLoop) {
  int seen = 0;
  for (int inside = 0; inside < 256; ++inside)
    for (int joined = 0; joined < 64; ++joined)
      for (int f = 0; f < 6; ++f) {
        const auto mask = static_cast<std::uint8_t>(inside);
        if (!face_is_ambiguous(mask, f) || (joined >> f & 1) != 0) continue;
        const CubeLoops before = cube_loops(mask, static_cast<std::uint8_t>(joined));
        if (!one_loop_takes_face(before, f)) continue;
        const CubeLoops after = cube_loops(mask, static_cast<std::uint8_t>(joined | 1 << f));
        EXPECT_EQ(after.count, before.count + 1);
        EXPECT_FALSE(one_loop_takes_face(after, f));
        ++seen;
      }
  EXPECT_GT(seen, 0);
}

}  // namespace
}  // namespace osteon
