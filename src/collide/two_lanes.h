#pragma once

// Two doubles that are worked on together. The SSE2 form and the plain form give the same bits.

#if defined(__SSE2__)
#include <emmintrin.h>
#endif

namespace osteon {

#if defined(__SSE2__)

struct TwoLanes {
  __m128d v;

  static TwoLanes load(const double* p) { return {_mm_loadu_pd(p)}; }
  static TwoLanes both(double x) { return {_mm_set1_pd(x)}; }
  void store(double* p) const { _mm_storeu_pd(p, v); }
  friend TwoLanes operator+(TwoLanes a, TwoLanes b) { return {_mm_add_pd(a.v, b.v)}; }
  friend TwoLanes operator-(TwoLanes a, TwoLanes b) { return {_mm_sub_pd(a.v, b.v)}; }
  friend TwoLanes operator*(TwoLanes a, TwoLanes b) { return {_mm_mul_pd(a.v, b.v)}; }
  friend TwoLanes abs(TwoLanes a) { return {_mm_andnot_pd(_mm_set1_pd(-0.0), a.v)}; }
  friend TwoLanes max(TwoLanes a, TwoLanes b) { return {_mm_max_pd(a.v, b.v)}; }
  double sum() const { return _mm_cvtsd_f64(_mm_add_sd(v, _mm_unpackhi_pd(v, v))); }
  /// Larger of the two lanes.
  double top() const { return _mm_cvtsd_f64(_mm_max_sd(v, _mm_unpackhi_pd(v, v))); }
  /// Bit k set: lane k exceeds x.
  friend int above(TwoLanes a, TwoLanes x) { return _mm_movemask_pd(_mm_cmpgt_pd(a.v, x.v)); }
};

#else

struct TwoLanes {
  double a, b;

  static TwoLanes load(const double* p) { return {p[0], p[1]}; }
  static TwoLanes both(double x) { return {x, x}; }
  void store(double* p) const {
    p[0] = a;
    p[1] = b;
  }
  friend TwoLanes operator+(TwoLanes x, TwoLanes y) { return {x.a + y.a, x.b + y.b}; }
  friend TwoLanes operator-(TwoLanes x, TwoLanes y) { return {x.a - y.a, x.b - y.b}; }
  friend TwoLanes operator*(TwoLanes x, TwoLanes y) { return {x.a * y.a, x.b * y.b}; }
  friend TwoLanes abs(TwoLanes x) { return {x.a < 0 ? -x.a : x.a, x.b < 0 ? -x.b : x.b}; }
  friend TwoLanes max(TwoLanes x, TwoLanes y) {
    return {x.a > y.a ? x.a : y.a, x.b > y.b ? x.b : y.b};
  }
  double sum() const { return a + b; }
  double top() const { return a > b ? a : b; }
  friend int above(TwoLanes p, TwoLanes q) { return (p.a > q.a ? 1 : 0) | (p.b > q.b ? 2 : 0); }
};

#endif

/// A vector whose coordinates fill both lanes.
struct ThreeLanes {
  TwoLanes x, y, z;
  template <class V>
  explicit ThreeLanes(const V& v)
      : x(TwoLanes::both(v[0])), y(TwoLanes::both(v[1])), z(TwoLanes::both(v[2])) {}
};

}  // namespace osteon
