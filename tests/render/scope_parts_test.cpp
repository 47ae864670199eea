#include "scope_parts.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace osteon {
namespace {

/// Whether a place in clip space lies in any of the triangles.
bool is_in(const TriMesh& mesh, double x, double y) {
  return std::any_of(mesh.triangles.begin(), mesh.triangles.end(), [&](const auto& triangle) {
    int left = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3 &a = mesh.vertices[triangle[k]], &b = mesh.vertices[triangle[(k + 1) % 3]];
      left += (b.x() - a.x()) * (y - a.y()) - (b.y() - a.y()) * (x - a.x()) >= 0;
    }
    return left == 0 || left == 3;
  });
}

TEST(UnseenCorners, ASmallPictureHasNone) {
  EXPECT_TRUE(unseen_corners(16).triangles.empty());
  EXPECT_TRUE(unseen_corners(77).triangles.empty());
  EXPECT_FALSE(unseen_corners(78).triangles.empty());
}

// Light is softened by so many pixels: these have to be drawn.
TEST(UnseenCorners, KeepOffTheRoundPictureAndCoverMostOfTheRest) {
  constexpr double kSoftened_px = 12;
  for (const int side : {160, 512, 1000, 2048}) {
    const TriMesh corners = unseen_corners(side);
    int unseen = 0, covered = 0;
    for (int row = 0; row < 200; ++row)
      for (int column = 0; column < 200; ++column) {
        const double x = (column + 0.5) / 100 - 1, y = (row + 0.5) / 100 - 1;
        const double off_px = (std::hypot(x, y) - 1) * side / 2;
        const bool in = is_in(corners, x, y);
        EXPECT_FALSE(in && off_px < kSoftened_px) << side << " " << x << " " << y;
        if (off_px < 17) continue;
        ++unseen;
        covered += in;
      }
    EXPECT_GT(covered, 0.97 * unseen) << side;
  }
}

}  // namespace
}  // namespace osteon
