#include "repair/edges.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <tuple>

#include "osteon/base/random.h"

namespace osteon {
namespace {

auto order_of(const EdgeUse& use) { return std::tuple(use.lo, use.hi, use.triangle, use.corner); }

/// Every side of every triangle once, in order, told right.
void check_uses(const std::vector<Triangle>& triangles) {
  const std::vector<EdgeUse> uses = edge_uses(triangles);
  ASSERT_EQ(uses.size(), 3 * triangles.size());
  for (std::size_t i = 0; i < uses.size(); ++i) {
    const EdgeUse& use = uses[i];
    if (i > 0) {
      EXPECT_LT(order_of(uses[i - 1]), order_of(use));
    }
    const Triangle& t = triangles[use.triangle];
    const std::uint32_t from = t[use.corner], to = t[(use.corner + 1u) % 3u];
    EXPECT_EQ(use.lo, std::min(from, to));
    EXPECT_EQ(use.hi, std::max(from, to));
    EXPECT_EQ(use.ascending, from < to);
  }
}

std::vector<Triangle> random_triangles(std::size_t count, double vertices) {
  Random random(3);
  std::vector<Triangle> triangles(count);
  for (Triangle& t : triangles)
    for (std::uint32_t& v : t) v = static_cast<std::uint32_t>(random.uniform(0, vertices));
  return triangles;
}

TEST(EdgeUses, OfNoTrianglesThereAreNone) { check_uses({}); }

TEST(EdgeUses, AreInOrderEvenWhereEdgesRepeatAndCollapse) {
  check_uses(random_triangles(500, 300));
  check_uses(random_triangles(500, 12));
  check_uses({{1, 1, 0}, {0, 1, 0}, {0, 0, 0}});
}

TEST(EdgeUses, AreInOrderAboutAVertexOfManyEdges) {
  std::vector<Triangle> star;
  for (std::uint32_t k = 300; k > 1; --k) star.push_back({0, k, k - 1});
  check_uses(star);
}

TEST(EdgeUses, AreInOrderWhereVerticesAreFarApart) { check_uses(random_triangles(20, 4e9)); }

}  // namespace
}  // namespace osteon
