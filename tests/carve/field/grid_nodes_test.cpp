#include "osteon/carve/grid_nodes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "osteon/base/random.h"

namespace osteon {
namespace {

BlockGrid grid() {
  BlockGrid out;
  out.cell_m = 0.0004;
  out.lo = Vec3(-0.001, 0.002, 0.003);
  out.blocks = {2, 3, 1};
  return out;
}

Vec3 place_of(const BlockGrid& grid, const GridNode& n) {
  const auto b = static_cast<int>(n.block), i = static_cast<int>(n.node);
  const Vec3 block(b % grid.blocks[0], b / grid.blocks[0] % grid.blocks[1],
                   b / (grid.blocks[0] * grid.blocks[1]));
  return grid.lo + grid.cell_m * (8 * block + Vec3(i % 8, i / 8 % 8, i / 64));
}

TEST(GridNodes, OutsideAndWhatIsNotANumberHaveNone) {
  const BlockGrid g = grid();
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const Vec3& p : {Vec3(-0.0013, 0.003, 0.004), Vec3(0, 0.003, 0.0071), Vec3(0, nan, 0.004)}) {
    EXPECT_FALSE(nearest_node(g, p));
    EXPECT_FALSE(nodes_about(g, p));
  }
  // Beyond the last node by less than half a cell there is a nearest one, but not eight.
  const Vec3 last = g.lo + g.cell_m * Vec3(15.3, 2, 2);
  EXPECT_TRUE(nearest_node(g, last));
  EXPECT_FALSE(nodes_about(g, last));
}

TEST(GridNodes, ANodeIsItsOwnNearestAndHasTheWholeShare) {
  const BlockGrid g = grid();
  const Vec3 p = g.lo + g.cell_m * Vec3(9, 17, 3);
  const auto near = nearest_node(g, p);
  ASSERT_TRUE(near);
  EXPECT_LT((place_of(g, *near) - p).norm(), 1e-12);
}

// Shares add up to one, and what is linear in space comes back as it is.
TEST(GridNodes, SharesWeighALinearValueExactly) {
  const BlockGrid g = grid();
  Random random(7);
  for (int i = 0; i < 200; ++i) {
    const Vec3 u(15 * random.uniform(), 23 * random.uniform(), 7 * random.uniform());
    const Vec3 p = g.lo + g.cell_m * u;
    const auto nodes = nodes_about(g, p);
    ASSERT_TRUE(nodes);
    double sum = 0;
    Vec3 weighed = Vec3::Zero();
    for (const NodeShare& n : *nodes) {
      sum += n.share;
      weighed += n.share * place_of(g, n.at);
    }
    EXPECT_NEAR(sum, 1, 1e-12);
    EXPECT_LT((weighed - p).norm(), 1e-12);
    const auto near = nearest_node(g, p);
    ASSERT_TRUE(near);
    EXPECT_LE((place_of(g, *near) - p).cwiseAbs().maxCoeff(), 0.5 * g.cell_m + 1e-12);
  }
}

}  // namespace
}  // namespace osteon
