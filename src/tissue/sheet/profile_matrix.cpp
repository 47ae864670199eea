#include "sheet/profile_matrix.h"

#include <algorithm>

namespace osteon {

double dot(const double* a, const double* b, std::size_t n) {
  double s0 = 0, s1 = 0, s2 = 0, s3 = 0;
  std::size_t i = 0;
  for (; i + 4 <= n; i += 4) {
    s0 += a[i] * b[i];
    s1 += a[i + 1] * b[i + 1];
    s2 += a[i + 2] * b[i + 2];
    s3 += a[i + 3] * b[i + 3];
  }
  for (; i < n; ++i) s0 += a[i] * b[i];
  return (s0 + s1) + (s2 + s3);
}

ProfileMatrix::ProfileMatrix(std::vector<std::uint32_t> first) : first_(std::move(first)) {
  std::uint32_t at = 0;
  for (std::uint32_t i = 0; i < first_.size(); ++i) {
    start_.push_back(at);
    at += i - first_[i] + 1;
  }
  rows_.assign(at, 0);
  pivots_.assign(first_.size(), 0);
}

// Row by row (Jennings 1966): with g_j = a_j - sum over k < j of g_k l_jk the row of L is g_j /
// d_j, and its pivot d = a - sum of g_j l_j. Sums run over the columns that both rows have.
bool ProfileMatrix::factor(std::size_t most_products) {
  for (std::size_t products = 0; done_ < first_.size() && products < most_products; ++done_) {
    const std::size_t i = done_;
    double* const row = rows_.data() + start_[i];
    const std::size_t from = first_[i];
    for (std::size_t j = from; j < i; ++j) {
      const std::size_t both = std::max<std::size_t>(from, first_[j]);
      const double* const other = rows_.data() + start_[j] + (both - first_[j]);
      if (j > both) row[j - from] -= dot(row + (both - from), other, j - both);
      products += j - both + 1;
    }
    double pivot = row[i - from];
    for (std::size_t j = from; j < i; ++j) {
      const double g = row[j - from];
      row[j - from] = g / pivots_[j];
      pivot -= g * row[j - from];
    }
    pivots_[i] = pivot;
  }
  return done_ == first_.size();
}

void go_forward(std::span<const std::uint32_t> first, std::span<const std::uint32_t> start,
                std::span<const double> rows, std::span<double> x) {
  for (std::size_t i = 0; i < first.size(); ++i)
    x[i] -= dot(rows.data() + start[i], x.data() + first[i], i - first[i]);
}

void go_back(std::span<const std::uint32_t> first, std::span<const std::uint32_t> start,
             std::span<const double> rows, std::span<double> x) {
  for (std::size_t i = first.size(); i-- > 0;) {
    const double* const row = rows.data() + start[i];
    double* const to = x.data() + first[i];
    const double by = x[i];
    for (std::size_t k = 0; k < i - first[i]; ++k) to[k] -= row[k] * by;
  }
}

void ProfileMatrix::solve(std::span<double> x) const {
  go_forward(first_, start_, rows_, x);
  for (std::size_t i = 0; i < x.size(); ++i) x[i] /= pivots_[i];
  go_back(first_, start_, rows_, x);
}

}  // namespace osteon
