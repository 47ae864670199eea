#pragma once

#include <cstdint>

#include "two_lanes.h"

namespace osteon {

/// Four doubles that are worked on together: the same bits with every register width.
struct FourLanes {
  TwoLanes lo = TwoLanes::both(0), hi = TwoLanes::both(0);

  static FourLanes load(const double* p) { return {TwoLanes::load(p), TwoLanes::load(p + 2)}; }
  /// Of whole numbers.
  static FourLanes load(const std::int16_t* p);
  /// The same, none above `most`.
  static FourLanes load(const std::int16_t* p, std::int16_t most);

  void add(double factor, const FourLanes& other) {
    const TwoLanes f = TwoLanes::both(factor);
    lo = lo + f * other.lo;
    hi = hi + f * other.hi;
  }
  double dot(const FourLanes& other) const { return (lo * other.lo + hi * other.hi).sum(); }
};

#if defined(__SSE2__)

namespace lanes {

inline FourLanes widened(__m128i four16) {
  const __m128i four32 = _mm_srai_epi32(_mm_unpacklo_epi16(four16, four16), 16);
  return {{_mm_cvtepi32_pd(four32)}, {_mm_cvtepi32_pd(_mm_unpackhi_epi64(four32, four32))}};
}

}  // namespace lanes

inline FourLanes FourLanes::load(const std::int16_t* p) {
  return lanes::widened(_mm_loadl_epi64(reinterpret_cast<const __m128i*>(p)));
}

inline FourLanes FourLanes::load(const std::int16_t* p, std::int16_t most) {
  const __m128i four = _mm_loadl_epi64(reinterpret_cast<const __m128i*>(p));
  return lanes::widened(_mm_min_epi16(four, _mm_set1_epi16(most)));
}

#else

inline FourLanes FourLanes::load(const std::int16_t* p) {
  return {{double(p[0]), double(p[1])}, {double(p[2]), double(p[3])}};
}

inline FourLanes FourLanes::load(const std::int16_t* p, std::int16_t most) {
  const auto at = [&](int i) { return double(p[i] < most ? p[i] : most); };
  return {{at(0), at(1)}, {at(2), at(3)}};
}

#endif

}  // namespace osteon
