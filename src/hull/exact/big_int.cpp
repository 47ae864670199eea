#include "exact/big_int.h"

#include <cassert>
#include <cmath>
#include <cstddef>
#include <limits>

namespace osteon::hull {

namespace {

/// |value| as mantissa * 2^exponent with an odd mantissa.
struct Odd {
  std::uint64_t mantissa;
  int exponent;
};

Odd odd_parts(double value) {
  int exponent = 0;
  const double fraction = std::frexp(std::abs(value), &exponent);
  auto mantissa = static_cast<std::uint64_t>(std::ldexp(fraction, 53));
  exponent -= 53;
  while ((mantissa & 1) == 0) {
    mantissa >>= 1;
    ++exponent;
  }
  return {mantissa, exponent};
}

}  // namespace

int lowest_bit(double value) {
  return value == 0 ? std::numeric_limits<int>::max() : odd_parts(value).exponent;
}

BigInt::BigInt(double value, int exponent) {
  if (value == 0) return;
  const Odd odd = odd_parts(value);
  const int shift = odd.exponent - exponent;
  assert(shift >= 0);
  limbs_.assign(static_cast<std::size_t>(shift / 32), 0);
  const int bits = shift % 32;
  const std::uint64_t low = (odd.mantissa & 0xffffffffu) << bits;
  const std::uint64_t high = ((odd.mantissa >> 32) << bits) + (low >> 32);
  limbs_.push_back(static_cast<std::uint32_t>(low));
  limbs_.push_back(static_cast<std::uint32_t>(high));
  limbs_.push_back(static_cast<std::uint32_t>(high >> 32));
  trim(limbs_);
  negative_ = value < 0;
}

void BigInt::trim(Limbs& a) {
  while (!a.empty() && a.back() == 0) a.pop_back();
}

int BigInt::compare(const Limbs& a, const Limbs& b) {
  if (a.size() != b.size()) return a.size() < b.size() ? -1 : 1;
  for (std::size_t i = a.size(); i-- > 0;) {
    if (a[i] != b[i]) return a[i] < b[i] ? -1 : 1;
  }
  return 0;
}

BigInt::Limbs BigInt::add(const Limbs& a, const Limbs& b) {
  const Limbs& longer = a.size() < b.size() ? b : a;
  const Limbs& shorter = a.size() < b.size() ? a : b;
  Limbs sum = longer;
  std::uint64_t carry = 0;
  for (std::size_t i = 0; i < sum.size(); ++i) {
    carry += sum[i];
    if (i < shorter.size()) carry += shorter[i];
    sum[i] = static_cast<std::uint32_t>(carry);
    carry >>= 32;
  }
  if (carry != 0) sum.push_back(static_cast<std::uint32_t>(carry));
  return sum;
}

BigInt::Limbs BigInt::subtract(const Limbs& a, const Limbs& b) {
  Limbs difference = a;
  std::int64_t borrow = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    borrow += static_cast<std::int64_t>(a[i]);
    if (i < b.size()) borrow -= static_cast<std::int64_t>(b[i]);
    difference[i] = static_cast<std::uint32_t>(borrow & 0xffffffff);
    borrow = borrow < 0 ? -1 : 0;
  }
  trim(difference);
  return difference;
}

BigInt BigInt::operator-() const {
  BigInt result = *this;
  result.negative_ = !negative_;
  return result;
}

BigInt BigInt::operator+(const BigInt& o) const {
  BigInt result;
  if (negative_ == o.negative_) {
    result.limbs_ = add(limbs_, o.limbs_);
    result.negative_ = negative_;
    return result;
  }
  const int order = compare(limbs_, o.limbs_);
  if (order == 0) return result;
  result.limbs_ = order > 0 ? subtract(limbs_, o.limbs_) : subtract(o.limbs_, limbs_);
  result.negative_ = order > 0 ? negative_ : o.negative_;
  return result;
}

BigInt BigInt::operator*(const BigInt& o) const {
  BigInt result;
  result.limbs_.assign(limbs_.size() + o.limbs_.size(), 0);
  for (std::size_t i = 0; i < limbs_.size(); ++i) {
    std::uint64_t carry = 0;
    for (std::size_t j = 0; j < o.limbs_.size(); ++j) {
      carry += std::uint64_t{limbs_[i]} * o.limbs_[j] + result.limbs_[i + j];
      result.limbs_[i + j] = static_cast<std::uint32_t>(carry);
      carry >>= 32;
    }
    result.limbs_[i + o.limbs_.size()] = static_cast<std::uint32_t>(carry);
  }
  trim(result.limbs_);
  result.negative_ = negative_ != o.negative_;
  return result;
}

}  // namespace osteon::hull
