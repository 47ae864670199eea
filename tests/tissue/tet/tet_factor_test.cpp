#include "tet/tet_factor.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>

#include "osteon/base/random.h"
#include "tet/tet_rows.h"

namespace osteon {
namespace {

/// Lower half of a positive matrix of nodes in two rings that do not know each other, so numbered
/// that neighbours are far.
Eigen::SparseMatrix<double> two_rings(int nodes) {
  Random random(5);
  std::vector<Eigen::Triplet<double>> all;
  const auto number = [&](int n) { return n * 7 % nodes; };
  for (int n = 0; n < nodes; ++n) {
    for (int k = 0; k < 3; ++k) all.emplace_back(3 * n + k, 3 * n + k, 30 + random.uniform());
    const int half = nodes / 2, ring = n / half * half;
    const int a = number(n), b = number(ring + (n - ring + 1) % half);
    for (int r = 0; r < 3; ++r)
      for (int c = 0; c < 3; ++c)
        all.emplace_back(3 * std::max(a, b) + r, 3 * std::min(a, b) + c, random.uniform(-2, 2));
  }
  Eigen::SparseMatrix<double> out(3 * nodes, 3 * nodes);
  out.setFromTriplets(all.begin(), all.end());
  return out;
}

TEST(TetFactor, SolvesInRowsAndSparse) {
  const Eigen::SparseMatrix<double> lower = two_rings(40);
  const Eigen::MatrixXd whole = Eigen::MatrixXd(lower).selfadjointView<Eigen::Lower>();
  const Eigen::VectorXd right = Eigen::VectorXd::LinSpaced(120, -1, 3);
  const Eigen::VectorXd want = whole.ldlt().solve(right);
  for (const bool in_rows : {true, false}) {
    TetFactor factor(in_rows ? TetFactor::kMostInRows : 0);
    factor.compute(lower);
    EXPECT_EQ(factor.in_rows(), in_rows);
    Eigen::VectorXd x = right;
    factor.solve(x);
    EXPECT_LT((x - want).norm(), 1e-12 * want.norm());
  }
}

TEST(TetFactor, OrderBringsNeighboursTogether) {
  // A chain, numbered at random.
  constexpr std::uint32_t kNodes = 31;
  std::vector<std::vector<std::uint32_t>> near(kNodes);
  for (std::uint32_t n = 0; n + 1 < kNodes; ++n) {
    near[12 * n % kNodes].push_back(12 * (n + 1) % kNodes);
    near[12 * (n + 1) % kNodes].push_back(12 * n % kNodes);
  }
  const std::vector<std::uint32_t> place = short_row_order(near);
  std::vector<bool> taken(kNodes, false);
  for (std::uint32_t n = 0; n < kNodes; ++n) {
    EXPECT_FALSE(taken[place[n]]);
    taken[place[n]] = true;
    for (const std::uint32_t other : near[n])
      EXPECT_EQ(std::max(place[n], place[other]) - std::min(place[n], place[other]), 1u);
  }
}

TEST(TetFactor, RegistersOfAllWidthsGiveTheSameBits) {
  Random random(9);
  std::vector<unsigned> first, start;
  std::vector<double> values;
  for (unsigned i = 0; i < 60; ++i) {
    first.push_back(i > 25 ? i - 25 : i / 3);
    start.push_back(static_cast<unsigned>(values.size()));
    for (unsigned j = first[i]; j < i; ++j) values.push_back(random.uniform(-0.2, 0.2));
  }
  const auto solved = [&](const tets::TetWork& work) {
    std::vector<double> x(60);
    for (std::size_t i = 0; i < x.size(); ++i) x[i] = 1 / (1.0 + static_cast<double>(i));
    const tets::TetProfile rows{first.data(), start.data(), values.data(), 60};
    work.forward(rows, x.data());
    work.back(rows, x.data());
    return x;
  };
  const std::vector<double> base = solved(tets::kTetWorkBase);
  EXPECT_NE(base[59], 1.0 / 60);
#if defined(__x86_64__)
  if (__builtin_cpu_supports("avx2")) {
    EXPECT_EQ(base, solved(tets::kTetWorkAvx2));
  }
  if (__builtin_cpu_supports("avx512f")) {
    EXPECT_EQ(base, solved(tets::kTetWorkAvx512));
  }
#endif
}

}  // namespace
}  // namespace osteon
