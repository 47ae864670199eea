#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace osteon::rods {

/// A symmetric matrix that is zero further than eight places from its diagonal, by columns from the
/// diagonal down: at(j + i, j) is column j, place i. That is a chain of nodes and frames, three
/// unknowns each, x0 w0 x1 w1 ..., in which each knows its next two.
class RodBand {
 public:
  static constexpr std::size_t kWidth = 9;

  void reset(std::size_t size) {
    size_ = size;
    // Room below the last column, so that loops need not end early.
    values_.assign((size + kWidth) * kWidth, 0.0);
  }
  std::size_t size() const { return size_; }
  double& at(std::size_t row, std::size_t column) {
    return values_[column * kWidth + (row - column)];
  }
  const double* column(std::size_t j) const { return values_.data() + j * kWidth; }

  /// Makes the unknown stay where it is.
  void hold(std::size_t k) {
    double* own = values_.data() + k * kWidth;
    std::fill(own, own + kWidth, 0.0);
    own[0] = 1;
    for (std::size_t i = 1; i < kWidth && i <= k; ++i) values_[(k - i) * kWidth + i] = 0;
  }

  void multiply(const std::vector<double>& x, std::vector<double>& out) const;
  /// L D L^T in place, without pivots: the matrix is positive.
  void factor();
  /// With the factors: A x = b, in place.
  void solve(std::vector<double>& x) const;

 private:
  std::size_t size_ = 0;
  std::vector<double> values_;
};

inline void RodBand::multiply(const std::vector<double>& x, std::vector<double>& out) const {
  out.assign(size_ + kWidth, 0.0);
  for (std::size_t j = 0; j < size_; ++j) {
    const double* c = column(j);
    out[j] += c[0] * x[j];
    for (std::size_t i = 1; i < kWidth && j + i < size_; ++i) {
      out[j + i] += c[i] * x[j];
      out[j] += c[i] * x[j + i];
    }
  }
  out.resize(size_);
}

inline void RodBand::factor() {
  for (std::size_t j = 0; j < size_; ++j) {
    double* c = values_.data() + j * kWidth;
    double own[kWidth];  // a copy, so that the compiler sees that the next columns are others
    std::copy(c, c + kWidth, own);
    const double per = 1 / own[0];
    for (std::size_t k = 1; k < kWidth; ++k) {
      double* to = c + k * kWidth;
      const double f = own[k] * per;
      c[k] = f;
      for (std::size_t i = k; i < kWidth; ++i) to[i - k] -= f * own[i];
    }
  }
}

inline void RodBand::solve(std::vector<double>& x) const {
  x.resize(size_ + kWidth, 0.0);
  for (std::size_t j = 0; j < size_; ++j) {
    const double* c = column(j);
    for (std::size_t i = 1; i < kWidth; ++i) x[j + i] -= c[i] * x[j];
  }
  std::fill(x.begin() + static_cast<std::ptrdiff_t>(size_), x.end(), 0.0);
  for (std::size_t j = size_; j-- > 0;) {
    const double* c = column(j);
    double sum = x[j] / c[0];
    for (std::size_t i = 1; i < kWidth; ++i) sum -= c[i] * x[j + i];
    x[j] = sum;
  }
  x.resize(size_);
}

}  // namespace osteon::rods
