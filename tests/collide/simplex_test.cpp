#include "simplex.h"

#include <gtest/gtest.h>

#include "collide/shapes.h"
#include "pair_rows.h"

namespace osteon {
namespace {

// Rows that always name the lowest violated plane.
struct LowestFirst : PairRows {
  using PairRows::PairRows;
  template <std::size_t N>
  Excess most_exceeded(const Vec3& x, double floor, const std::array<std::uint32_t, N>&) const {
    return first_exceeded(x, floor + 1e-14);
  }
};

template <class Basis>
SimplexEnd run_with_limit(const ConvexBody& a, const ConvexBody& b, const Pose& X_AB, int limit) {
  const PairRows rows(a, b, X_AB);
  Basis basis;
  bool loaded;
  if constexpr (Basis::kRows == 4)
    loaded = load_basis(basis, rows, a.basis);
  else
    loaded = load_basis(basis, rows, a.corner);
  EXPECT_TRUE(loaded && dual_feasible(basis));
  basis.solve();
  return run_simplex(basis, rows, 0, limit);
}

TEST(Simplex, StopsAtThePivotLimit) {
  const ConvexBody a = shapes::body(shapes::ellipsoid(3, {0.01, 0.015, 0.04}));
  const ConvexBody b = shapes::body(shapes::ellipsoid(1, {0.002, 0.002, 0.01}));
  const Pose X_AB{Vec3(0.004, 0.012, 0.01), Quat::Identity()};
  const SimplexEnd full = run_with_limit<DepthBasis>(a, b, X_AB, 400);
  ASSERT_EQ(full.status, LpStatus::kOptimal);
  ASSERT_GT(full.pivots, 2);
  for (int limit = 0; limit < full.pivots; ++limit) {
    const SimplexEnd cut = run_with_limit<DepthBasis>(a, b, X_AB, limit);
    EXPECT_EQ(cut.status, LpStatus::kPivotLimit);
    EXPECT_EQ(cut.pivots, limit);
    EXPECT_GT(cut.residual, 0);
  }
  EXPECT_EQ(run_with_limit<DepthBasis>(a, b, X_AB, full.pivots).status, LpStatus::kOptimal);
  EXPECT_EQ(run_with_limit<CornerBasis>(a, b, X_AB, 0).status, LpStatus::kPivotLimit);
}

TEST(Simplex, RatioTestKeepsWeightsAndPrefersLargePivots) {
  const std::array<std::uint32_t, 3> ids = {7, 3, 5};
  EXPECT_EQ(leaving_row<3>({1, 1, 1}, {-1, 0, -2}, ids, false), -1);
  EXPECT_EQ(leaving_row<3>({1, 1, 1}, {0.5, 2, 1}, ids, false), 1);
  // Two rows of weight nought: the larger pivot, or the lower id under Bland's rule.
  EXPECT_EQ(leaving_row<3>({0, 1, 0}, {1e-6, 2, 1}, ids, false), 2);
  EXPECT_EQ(leaving_row<3>({0, 1, 0}, {1, 2, 1}, ids, true), 2);
  EXPECT_EQ(leaving_row<3>({0, 0, 0}, {1, 2, 1}, ids, true), 1);
}

TEST(Simplex, BlandsRuleReachesTheSameOptimum) {
  const ConvexBody a = shapes::body(shapes::octahedron({0.01, 0.01, 0.01}));
  const ConvexBody b = shapes::body(shapes::ellipsoid(1, {0.002, 0.004, 0.01}));
  Random random(61);
  for (int i = 0; i < 200; ++i) {
    const Pose X_AB = shapes::random_pose(random, 0.03);
    const LowestFirst rows(a, b, X_AB);
    DepthBasis basis;
    ASSERT_TRUE(load_basis(basis, rows, a.basis));
    basis.solve();
    ASSERT_EQ(run_simplex(basis, rows, 0, 400).status, LpStatus::kOptimal);
    EXPECT_NEAR(basis.t, lp_depth(a, b, X_AB).t, 1e-12);
  }
}

}  // namespace
}  // namespace osteon
