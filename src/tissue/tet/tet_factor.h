#pragma once

#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>
#include <vector>

#include "sheet/profile_matrix.h"

namespace osteon {

/// A symmetric positive matrix with three unknowns a node, factored once (L D L^T) and solved
/// often. A small one is kept by rows from the first entry on, nodes in an order that keeps the
/// rows short, so that solving goes through whole registers; of a large one that would hold too
/// many zeros.
class TetFactor {
 public:
  static constexpr std::size_t kMostInRows = 1'000'000;  ///< entries
  explicit TetFactor(std::size_t most_in_rows = kMostInRows) : most_in_rows_(most_in_rows) {}

  /// The lower half.
  void compute(const Eigen::SparseMatrix<double>& lower);
  void solve(Eigen::VectorXd& x) const;  ///< in place
  bool in_rows() const { return !place_.empty(); }

 private:
  std::size_t most_in_rows_;
  std::vector<std::uint32_t> place_;  ///< of each node in the order of the rows
  ProfileMatrix profile_;
  Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>, Eigen::Lower> sparse_;
};

/// Place of each node in an order from node to neighbour, breadth first from one end and turned
/// about (reverse Cuthill-McKee): neighbours are near.
std::vector<std::uint32_t> short_row_order(const std::vector<std::vector<std::uint32_t>>& near);

}  // namespace osteon
