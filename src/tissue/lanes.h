#pragma once

// Registers of doubles (the vector types of g++ and clang++), loaded from any place. Includes
// nothing, see hex_kernel.h.

namespace osteon::hex {

template <int Bytes>
struct Register {
  typedef double Lanes __attribute__((vector_size(Bytes)));
};

template <class V>
inline constexpr long kLanes = static_cast<long>(sizeof(V) / sizeof(double));

template <class V>
static inline V load(const double* from) {
  V v;
  __builtin_memcpy(&v, from, sizeof v);
  return v;
}

template <class V>
static inline void store(double* to, const V& v) {
  __builtin_memcpy(to, &v, sizeof v);
}

/// j^(-1/3) within 4 %: the exponent of a float divided by -3, by its bits.
inline constexpr unsigned kGuessBits = 0x54a2fa8cu;

static inline double guessed_cube_root(double j) {
  const float single = static_cast<float>(j);
  unsigned bits = 0;
  __builtin_memcpy(&bits, &single, sizeof bits);
  bits = kGuessBits - bits / 3u;
  float guess = 0;
  __builtin_memcpy(&guess, &bits, sizeof guess);
  return static_cast<double>(guess);
}

template <class V>
static inline V guessed_cube_root(const V& j) {
  typedef float Floats __attribute__((vector_size(sizeof(V) / 2)));
  typedef unsigned Bits __attribute__((vector_size(sizeof(V) / 2)));
  const Floats single = __builtin_convertvector(j, Floats);
  Bits bits;
  __builtin_memcpy(&bits, &single, sizeof bits);
  bits = kGuessBits - bits / 3u;
  Floats guess;
  __builtin_memcpy(&guess, &bits, sizeof guess);
  return __builtin_convertvector(guess, V);
}

}  // namespace osteon::hex
