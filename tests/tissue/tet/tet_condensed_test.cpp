#include <gtest/gtest.h>

#include <Eigen/LU>

#include "../beam.h"
#include "osteon/tissue/solve.h"
#include "osteon/tissue/tet_solid.h"
#include "tet/tet_condensed.h"

namespace osteon {
namespace {

using test::Bar;

struct Block {
  TetSolid solid;
  Supports supports;
};

// Clamped on x = 0, one node drawn, one pushed, weight on all.
Block block_of(TetOrder order) {
  TetSolidDef def;
  def.mesh = split_into_tetrahedra({{3, 3, 3}, 0.01, Vec3::Zero()});
  def.material = {1e5, 0.45, 1000, 0};
  def.order = order;
  Block out{*make_tet_solid(def), {}};
  out.supports.gravity_m_per_s2 = {1, -2, -9.81};
  out.supports.entries = 2;
  for (std::uint32_t i = 0; i < out.solid.rest_W.size(); ++i) {
    const Vec3& p = out.solid.rest_W[i];
    for (std::uint32_t k = 0; k < 3; ++k)
      if (p.x() < 1e-9) out.supports.held.push_back({i, k, 0, 0, 0});
    if ((p - Vec3(0.03, 0.03, 0.03)).norm() < 1e-9)
      out.supports.held.push_back({i, 1, 0.002, 0, 1});
    if ((p - Vec3(0.03, 0, 0.03)).norm() < 1e-9)
      out.supports.loads.push_back({i, {0.01, 0.02, 0.03}, 0});
  }
  return out;
}

// The whole system, column by column from the public forces, by Gauss with pivots.
SolidState solved_whole(const Block& block) {
  const std::size_t n = block.solid.rest_W.size();
  const auto size = static_cast<Eigen::Index>(3 * n);
  SolidState state = state_at_rest(n, true);
  Eigen::MatrixXd k(size, size);
  Eigen::VectorXd f = Eigen::VectorXd::Zero(size);
  for (std::size_t j = 0; j < 3 * n; ++j) {
    state.moved_m[j % 3][j / 3] = 1;
    const SolidState::Field force = elastic_forces(block.solid, state);
    state.moved_m[j % 3][j / 3] = 0;
    for (std::size_t i = 0; i < 3 * n; ++i)
      k(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) = -force[i % 3][i / 3];
  }
  for (std::size_t i = 0; i < n; ++i)
    f.segment<3>(static_cast<Eigen::Index>(3 * i)) =
        block.solid.mass_kg[i] * block.supports.gravity_m_per_s2;
  for (const NodeLoad& load : block.supports.loads) f.segment<3>(3 * load.slot) += load.force_n;
  for (const HeldAxis& h : block.supports.held) {
    const auto at = static_cast<Eigen::Index>(3 * h.slot + h.axis);
    k.row(at).setZero();
    k(at, at) = 1;
    f[at] = h.to_m;
  }
  const Eigen::VectorXd u = k.partialPivLu().solve(f);
  for (std::size_t j = 0; j < 3 * n; ++j)
    state.moved_m[j % 3][j / 3] = u[static_cast<Eigen::Index>(j)];
  return state;
}

TEST(TetCondensed, SurfaceIsAllButTheInnerNodes) {
  const Block block = block_of(TetOrder::kLinear);
  const auto surface = surface_nodes(block.solid);
  EXPECT_EQ(surface.size(), 64u - 8u);
  for (const std::uint32_t n : surface) {
    const Vec3 p = block.solid.rest_W[n] / 0.03;
    EXPECT_LT(std::min(p.minCoeff(), 1 - p.maxCoeff()), 1e-9);
  }
}

TEST(TetCondensed, SurfaceGoesWhereTheWholeSystemPutsIt) {
  for (const TetOrder order : {TetOrder::kLinear, TetOrder::kQuadratic}) {
    const Block block = block_of(order);
    const auto condensed = CondensedSolid::make(block.solid, block.supports);
    ASSERT_TRUE(condensed) << condensed.error().message();
    const SolidState got = condensed->solve(1), want = solved_whole(block);
    double most = 0, worst = 0;
    for (std::size_t i = 0; i < block.solid.rest_W.size(); ++i) {
      most = std::max(most, want.moved(i).norm());
      worst = std::max(worst, (got.moved(i) - want.moved(i)).norm());
    }
    EXPECT_GT(most, 1e-3);
    EXPECT_LT(worst, 1e-9 * most);
    // Supports carry loads and weight.
    Vec3 sum = Vec3(0.01, 0.02, 0.03);
    for (const double m : block.solid.mass_kg) sum += m * block.supports.gravity_m_per_s2;
    for (const Vec3& f : condensed->reactions(got, 1)) sum += f;
    EXPECT_LT(sum.norm(), 1e-9);
  }
}

TEST(TetCondensed, RefusesABodyThatIsNotHeld) {
  Block block = block_of(TetOrder::kLinear);
  block.supports.held.clear();
  const auto condensed = CondensedSolid::make(block.solid, block.supports);
  ASSERT_FALSE(condensed);
  EXPECT_NE(condensed.error().what.find("'fixed'"), std::string::npos);
}

TEST(TetCondensed, ASceneIsSolvedAtOnce) {
  Bar bar;
  bar.length_m = 0.12;
  bar.cells_across = 2;
  SolveScene scene = test::cantilever(bar, TissueModel::kLinear, 0.003);
  scene.condensed = true;
  const auto result = solve(scene);
  ASSERT_TRUE(result) << result.error().message();
  EXPECT_TRUE(result->settled);
  EXPECT_EQ(result->steps, 1u);
  EXPECT_NEAR(-result->probes[0].moved_m.z() / test::timoshenko_m(bar, 0.003), 1, 0.03);
  EXPECT_NEAR(result->reactions[0].force_n.z(), 0.003, 1e-9);
}

}  // namespace
}  // namespace osteon
