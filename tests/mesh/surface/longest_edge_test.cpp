#include "osteon/mesh/longest_edge.h"

#include <gtest/gtest.h>

namespace osteon {
namespace {

TEST(LongestEdge, OfAPointIsNone) {
  const LongestEdge edge = longest_edge({Vec3::Ones(), Vec3::Ones(), Vec3::Ones()});
  EXPECT_EQ(edge.from, 0u);
  EXPECT_EQ(edge.length2, 0);
}

TEST(LongestEdge, IsNamedByItsFirstCorner) {
  const Vec3 a(0, 0, 0), b(3, 0, 0), c(0, 4, 0);
  EXPECT_EQ(longest_edge({a, b, c}).from, 1u);
  EXPECT_EQ(longest_edge({b, c, a}).from, 0u);
  EXPECT_EQ(longest_edge({c, a, b}).from, 2u);
  EXPECT_DOUBLE_EQ(longest_edge({a, b, c}).length2, 25);
}

TEST(LongestEdge, OfEqualOnesIsTheFirst) {
  EXPECT_EQ(longest_edge({Vec3::UnitX(), Vec3::UnitY(), Vec3::UnitZ()}).from, 0u);
}

}  // namespace
}  // namespace osteon
