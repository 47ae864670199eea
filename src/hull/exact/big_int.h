#pragma once

#include <cstdint>
#include <vector>

namespace osteon::hull {

/// Signed integer of any size, for the few orientation tests whose terms would leave the range of
/// doubles. Slow and plain.
class BigInt {
 public:
  BigInt() = default;
  /// value * 2^-exponent, which must be an integer.
  BigInt(double value, int exponent);

  int sign() const { return limbs_.empty() ? 0 : (negative_ ? -1 : 1); }
  BigInt operator-() const;
  BigInt operator+(const BigInt& o) const;
  BigInt operator-(const BigInt& o) const { return *this + (-o); }
  BigInt operator*(const BigInt& o) const;

 private:
  using Limbs = std::vector<std::uint32_t>;  ///< least significant first, no leading zeros
  static int compare(const Limbs& a, const Limbs& b);
  static Limbs add(const Limbs& a, const Limbs& b);
  static Limbs subtract(const Limbs& a, const Limbs& b);  ///< a >= b
  static void trim(Limbs& a);

  Limbs limbs_;
  bool negative_ = false;
};

/// Exponent of the lowest bit that `value` has; a large number for zero.
int lowest_bit(double value);

}  // namespace osteon::hull
