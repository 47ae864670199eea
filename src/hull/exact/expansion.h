#pragma once

#include <array>
#include <cmath>
#include <cstddef>

// Arithmetic without rounding on sums of doubles, after Shewchuk, "Adaptive Precision
// Floating-Point Arithmetic and Fast Robust Geometric Predicates", 1997. Needs one rounding per
// operation (SSE2, no contraction) and no underflow or overflow of any term.

namespace osteon::hull {

/// value + error equals the exact result.
struct TwoTerm {
  double value;
  double error;
};

/// Knuth's sum (Shewchuk, theorem 7).
inline TwoTerm two_sum(double a, double b) {
  const double x = a + b;
  const double b_virtual = x - a;
  const double a_virtual = x - b_virtual;
  return {x, (a - a_virtual) + (b - b_virtual)};
}

inline TwoTerm two_diff(double a, double b) { return two_sum(a, -b); }

/// Halves of 26 bits each (Veltkamp; Shewchuk, theorem 17).
inline TwoTerm split(double a) {
  const double c = 134217729.0 * a;  // 2^27 + 1
  const double high = c - (c - a);
  return {high, a - high};
}

/// Dekker's product (Shewchuk, theorem 18).
inline TwoTerm two_product(double a, double b) {
  const double x = a * b;
  const TwoTerm sa = split(a);
  const TwoTerm sb = split(b);
  const double e1 = x - sa.value * sb.value;
  const double e2 = e1 - sa.error * sb.value;
  const double e3 = e2 - sa.value * sb.error;
  return {x, sa.error * sb.error - e3};
}

/// Sum of non-overlapping terms of growing magnitude, without zeros; exact.
template <std::size_t N>
class Expansion {
 public:
  Expansion() = default;
  explicit Expansion(TwoTerm t) {
    push(t.error);
    push(t.value);
  }

  /// GROW-EXPANSION with removal of zeros (Shewchuk, theorem 10).
  void add(double b) {
    double carry = b;
    std::size_t kept = 0;
    for (std::size_t i = 0; i < size_; ++i) {
      const TwoTerm t = two_sum(carry, terms_[i]);
      if (t.error != 0) terms_[kept++] = t.error;
      carry = t.value;
    }
    size_ = kept;
    push(carry);
  }

  template <std::size_t M>
  void add(const Expansion<M>& other) {
    for (std::size_t i = 0; i < other.size(); ++i) add(other.term(i));
  }

  template <std::size_t M>
  void subtract(const Expansion<M>& other) {
    for (std::size_t i = 0; i < other.size(); ++i) add(-other.term(i));
  }

  std::size_t size() const { return size_; }
  double term(std::size_t i) const { return terms_[i]; }
  /// The last term outweighs all the others together.
  int sign() const { return size_ == 0 ? 0 : (terms_[size_ - 1] > 0 ? 1 : -1); }
  double estimate() const {
    double sum = 0;
    for (std::size_t i = 0; i < size_; ++i) sum += terms_[i];
    return sum;
  }

 private:
  void push(double t) {
    if (t != 0) terms_[size_++] = t;
  }

  std::array<double, N> terms_;
  std::size_t size_ = 0;
};

/// Exact product, term by term.
template <std::size_t N, std::size_t M>
Expansion<2 * N * M> product(const Expansion<N>& a, const Expansion<M>& b) {
  Expansion<2 * N * M> result;
  for (std::size_t i = 0; i < a.size(); ++i) {
    for (std::size_t j = 0; j < b.size(); ++j) {
      const TwoTerm t = two_product(a.term(i), b.term(j));
      result.add(t.error);
      result.add(t.value);
    }
  }
  return result;
}

}  // namespace osteon::hull
