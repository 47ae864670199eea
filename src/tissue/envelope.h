#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

namespace osteon {

/// A symmetric positive matrix by rows from the first entry that is not zero to the diagonal, and
/// in the same place its Cholesky factor: L L^T = K, row by row. What is outside of the envelope
/// stays zero (George and Liu 1981).
class Envelope {
 public:
  static constexpr std::size_t kWide = 8;  ///< columns that are solved together
  explicit Envelope(std::vector<std::size_t> first)
      : first_(std::move(first)), row_(first_.size()) {
    std::size_t size = 0;
    for (std::size_t i = 0; i < first_.size(); ++i) {
      row_[i] = size - first_[i];
      size += i - first_[i] + 1;
    }
    values_.assign(size, 0);
  }
  std::size_t size() const { return first_.size(); }
  void clear() { std::fill(values_.begin(), values_.end(), 0); }
  double& at(std::size_t i, std::size_t j) { return values_[row_[i] + j]; }
  double at(std::size_t i, std::size_t j) const { return values_[row_[i] + j]; }

  void factor_row(std::size_t i) {
    for (std::size_t j = first_[i]; j <= i; ++j) {
      double sum = at(i, j);
      for (std::size_t k = std::max(first_[i], first_[j]); k < j; ++k) sum -= at(i, k) * at(j, k);
      at(i, j) = j < i ? sum / at(j, j) : std::sqrt(std::max(sum, 1e-300));
    }
  }

  using Columns = std::vector<std::array<double, kWide>>;
  // x has nothing before row `from`, and rows before it are not asked for.
  void solve(Columns& x, std::size_t from) const {
    for (std::size_t i = from; i < size(); ++i) {
      for (std::size_t j = std::max(from, first_[i]); j < i; ++j) add(x[i], -at(i, j), x[j]);
      scale(x[i], 1 / at(i, i));
    }
    for (std::size_t i = size(); i-- > from;) {
      scale(x[i], 1 / at(i, i));
      for (std::size_t j = std::max(from, first_[i]); j < i; ++j) add(x[j], -at(i, j), x[i]);
    }
  }

 private:
  using Row = std::array<double, kWide>;
  static void add(Row& to, double by, const Row& from) {
    for (std::size_t c = 0; c < kWide; ++c) to[c] += by * from[c];
  }
  static void scale(Row& row, double by) {
    for (double& x : row) x *= by;
  }
  std::vector<std::size_t> first_, row_;
  std::vector<double> values_;
};

}  // namespace osteon
