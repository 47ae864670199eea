#pragma once

#include <complex>
#include <vector>

namespace osteon {

/// Discrete Fourier transform X[k] = sum_n x[n] exp(-2 pi i k n / N), in place, by the radix-2
/// algorithm of Cooley and Tukey (1965). The size must be a power of two.
void fft(std::vector<std::complex<double>>& x);

}  // namespace osteon
