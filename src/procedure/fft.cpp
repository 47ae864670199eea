#include "fft.h"

#include <bit>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <numbers>

namespace osteon {
namespace {

using Complex = std::complex<double>;

void reverse_bits(std::vector<Complex>& x) {
  const std::size_t n = x.size();
  for (std::size_t i = 1, j = 0; i < n; ++i) {
    // j counts with its highest bit as the lowest.
    std::size_t bit = n >> 1;
    for (; j & bit; bit >>= 1) j ^= bit;
    j ^= bit;
    if (i < j) std::swap(x[i], x[j]);
  }
}

// exp(-2 pi i k / n) for k < n / 2.
std::vector<Complex> roots_of_unity(std::size_t n) {
  std::vector<Complex> roots(n / 2);
  for (std::size_t k = 0; k < roots.size(); ++k) {
    const double angle = -2 * std::numbers::pi * static_cast<double>(k) / static_cast<double>(n);
    roots[k] = {std::cos(angle), std::sin(angle)};
  }
  return roots;
}

// std::complex's own product looks for infinities, which takes most of its time.
Complex times(const Complex& a, const Complex& b) {
  return {a.real() * b.real() - a.imag() * b.imag(), a.real() * b.imag() + a.imag() * b.real()};
}

}  // namespace

void fft(std::vector<Complex>& x) {
  const std::size_t n = x.size();
  assert(std::has_single_bit(n));
  const std::vector<Complex> roots = roots_of_unity(n);
  reverse_bits(x);
  for (std::size_t half = 1; half < n; half *= 2) {
    const std::size_t stride = n / (2 * half);
    for (std::size_t start = 0; start < n; start += 2 * half) {
      for (std::size_t k = 0; k < half; ++k) {
        const Complex odd = times(roots[k * stride], x[start + k + half]);
        x[start + k + half] = x[start + k] - odd;
        x[start + k] += odd;
      }
    }
  }
}

}  // namespace osteon
