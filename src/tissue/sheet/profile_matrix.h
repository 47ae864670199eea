#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace osteon {

/// A symmetric positive matrix of which each row keeps what lies from its first entry to its pivot.
/// Factored into L D L^T in place, some rows at a time.
class ProfileMatrix {
 public:
  ProfileMatrix() = default;
  /// `first`: of each row, its first column.
  explicit ProfileMatrix(std::vector<std::uint32_t> first);

  /// i >= j, within the row's profile.
  double& at(std::size_t i, std::size_t j) { return rows_[start_[i] + (j - first_[i])]; }
  /// Goes on from where it was, until that much work is done. True: the whole is factored.
  bool factor(std::size_t most_products);
  /// In place; after `factor`.
  void solve(std::span<double> x) const;

  std::vector<std::uint32_t> first_, start_;
  std::vector<double> rows_;  ///< below the pivots; the last of each row is not used
  std::vector<double> pivots_;

 private:
  std::size_t done_ = 0;
};

/// Sum of products in four rows: the same bits whatever registers do it.
double dot(const double* a, const double* b, std::size_t n);
/// Of a factored matrix: x becomes L^-1 x.
void go_forward(std::span<const std::uint32_t> first, std::span<const std::uint32_t> start,
                std::span<const double> rows, std::span<double> x);
/// x becomes L^-T x.
void go_back(std::span<const std::uint32_t> first, std::span<const std::uint32_t> start,
             std::span<const double> rows, std::span<double> x);

}  // namespace osteon
