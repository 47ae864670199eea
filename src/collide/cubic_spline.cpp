#include "cubic_spline.h"

#include "four_lanes.h"

#if defined(__SSE2__) && defined(__GNUC__)
#define OSTEON_WIDE_SPLINES
#include <immintrin.h>
#endif

namespace osteon {
namespace {

#if defined(OSTEON_WIDE_SPLINES)

// Each operation below has its like in CubicSpline and in the narrow sum, in the same order: that
// keeps the bits. Products and sums must not be made in one operation, which AVX2 alone cannot.
#define OSTEON_WIDE __attribute__((target("avx2")))

// The splines of three axes at once: [n][axis].
struct ThreeSplines {
  alignas(32) double w[4][4], d[4][4];
};

OSTEON_WIDE inline void find_splines(const Vec3& t_cell, ThreeSplines& out) {
  const __m256d t = _mm256_set_pd(0, t_cell.z(), t_cell.y(), t_cell.x());
  const __m256d u = 1.0 - t, t2 = t * t;
  const __m256d w0 = u * u * u / 6.0;
  const __m256d w1 = (4.0 - 6.0 * t2 + 3.0 * t2 * t) / 6.0;
  const __m256d w3 = t2 * t / 6.0;
  const __m256d d0 = -0.5 * u * u, d1 = 1.5 * t2 - 2.0 * t, d3 = 0.5 * t2;
  _mm256_store_pd(out.w[0], w0);
  _mm256_store_pd(out.w[1], w1);
  _mm256_store_pd(out.w[2], 1.0 - w0 - w1 - w3);
  _mm256_store_pd(out.w[3], w3);
  _mm256_store_pd(out.d[0], d0);
  _mm256_store_pd(out.d[1], d1);
  _mm256_store_pd(out.d[2], -(d0 + d1 + d3));
  _mm256_store_pd(out.d[3], d3);
}

OSTEON_WIDE inline __m256d along_x(const double (&of)[4][4]) {
  return _mm256_set_pd(of[3][0], of[2][0], of[1][0], of[0][0]);
}

OSTEON_WIDE inline double wide_dot(__m256d a, __m256d b) {
  const __m256d product = a * b;
  const __m128d two = _mm256_castpd256_pd128(product) + _mm256_extractf128_pd(product, 1);
  return two[0] + two[1];
}

OSTEON_WIDE inline __m256d row_of(const SplineRows& rows, std::size_t row, __m128i most) {
  const auto* from = reinterpret_cast<const __m128i*>(rows.row[row]);
  return _mm256_cvtepi32_pd(_mm_cvtepi16_epi32(_mm_min_epi16(_mm_loadl_epi64(from), most)));
}

OSTEON_WIDE double value_wide(const SplineRows& rows, const Vec3& t) {
  ThreeSplines of;
  find_splines(t, of);
  const __m128i most = _mm_set1_epi16(rows.most);
  __m256d v = _mm256_setzero_pd();
  for (std::size_t k = 0; k < 4; ++k) {
    __m256d sum = _mm256_setzero_pd();
    for (std::size_t j = 0; j < 4; ++j)
      sum = sum + _mm256_broadcast_sd(&of.w[j][1]) * row_of(rows, 4 * k + j, most);
    v = v + _mm256_broadcast_sd(&of.w[k][2]) * sum;
  }
  return wide_dot(v, along_x(of.w));
}

OSTEON_WIDE SplineSum sum_splines_wide(const SplineRows& rows, const Vec3& t) {
  ThreeSplines of;
  find_splines(t, of);
  const __m128i most = _mm_set1_epi16(rows.most);
  __m256d v = _mm256_setzero_pd(), along_y = v, along_z = v;
  for (std::size_t k = 0; k < 4; ++k) {
    __m256d sum = _mm256_setzero_pd(), sum_y = sum;
    for (std::size_t j = 0; j < 4; ++j) {
      const __m256d h = row_of(rows, 4 * k + j, most);
      sum = sum + _mm256_broadcast_sd(&of.w[j][1]) * h;
      sum_y = sum_y + _mm256_broadcast_sd(&of.d[j][1]) * h;
    }
    const __m256d z_w = _mm256_broadcast_sd(&of.w[k][2]);
    v = v + z_w * sum;
    along_y = along_y + z_w * sum_y;
    along_z = along_z + _mm256_broadcast_sd(&of.d[k][2]) * sum;
  }
  const __m256d w = along_x(of.w), d = along_x(of.d);
  return {wide_dot(v, w), {wide_dot(v, d), wide_dot(along_y, w), wide_dot(along_z, w)}};
}

#endif

// In the widest registers that this processor has.
struct Sums {
  SplineSum (*sum)(const SplineRows&, const Vec3&) = sum_splines_narrow;
  double (*value)(const SplineRows&, const Vec3&) = value_of_splines_narrow;
};

Sums widest() {
#if defined(OSTEON_WIDE_SPLINES)
  if (__builtin_cpu_supports("avx2")) return {sum_splines_wide, value_wide};
#endif
  return {};
}

const Sums& sums() {
  static const Sums kSums = widest();
  return kSums;
}

}  // namespace

SplineSum sum_splines_narrow(const SplineRows& rows, const Vec3& t) {
  const CubicSpline x(t.x()), y(t.y()), z(t.z());
  FourLanes v, along_y, along_z;
  for (std::size_t k = 0; k < 4; ++k) {
    FourLanes sum, sum_y;
    for (std::size_t j = 0; j < 4; ++j) {
      const FourLanes h = FourLanes::load(rows.row[4 * k + j], rows.most);
      sum.add(y.w[j], h);
      sum_y.add(y.d[j], h);
    }
    v.add(z.w[k], sum);
    along_y.add(z.w[k], sum_y);
    along_z.add(z.d[k], sum);
  }
  const FourLanes w = FourLanes::load(x.w.data()), d = FourLanes::load(x.d.data());
  return {v.dot(w), {v.dot(d), along_y.dot(w), along_z.dot(w)}};
}

double value_of_splines_narrow(const SplineRows& rows, const Vec3& t) {
  const CubicSpline x(t.x()), y(t.y()), z(t.z());
  FourLanes v;
  for (std::size_t k = 0; k < 4; ++k) {
    FourLanes sum;
    for (std::size_t j = 0; j < 4; ++j)
      sum.add(y.w[j], FourLanes::load(rows.row[4 * k + j], rows.most));
    v.add(z.w[k], sum);
  }
  return v.dot(FourLanes::load(x.w.data()));
}

SplineSum sum_splines(const SplineRows& rows, const Vec3& t) { return sums().sum(rows, t); }

double value_of_splines(const SplineRows& rows, const Vec3& t) { return sums().value(rows, t); }

}  // namespace osteon
