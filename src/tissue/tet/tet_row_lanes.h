#pragma once

// The loops over points of tetrahedra, compiled for each width of registers (tet_rows.h). Same bits
// everywhere: each point is reckoned by itself, in the order written, and none depends on how many
// share a register.

#include "hex/hex_element.h"
#include "tet/tet_rows.h"

namespace osteon::tets {

using hex::kLanes;
using hex::load;
using hex::store;

template <class V>
struct Square {
  V m[3][3];
};

template <class V>
static inline Square<V> square_at(const double* from, long stride) {
  Square<V> out;
  for (int k = 0; k < 9; ++k) out.m[k / 3][k % 3] = load<V>(from + k * stride);
  return out;
}

template <class V>
static inline void put_square(double* to, long stride, const Square<V>& v) {
  for (int k = 0; k < 9; ++k) store(to + k * stride, v.m[k / 3][k % 3]);
}

/// grad v, rows: axes of v.
template <class V>
static inline Square<V> gradient_at(const TetRows& rows, const double* v, long i) {
  Square<V> h;
  for (auto& row : h.m)
    for (V& e : row) e = load<V>(rows.volume + i) * 0;
  for (long a = 0; a < rows.nodes; ++a) {
    const unsigned* node = rows.node + a * rows.stride + i;
    V x, y, z;
    for (long k = 0; k < kLanes<V>; ++k) {
      const double* at = v + 3 * static_cast<long>(node[k]);
      x[k] = at[0];
      y[k] = at[1];
      z[k] = at[2];
    }
    const double* slope = rows.slope + 3 * a * rows.stride + i;
    for (int c = 0; c < 3; ++c) {
      const V s = load<V>(slope + c * rows.stride);
      h.m[0][c] = h.m[0][c] + x * s;
      h.m[1][c] = h.m[1][c] + y * s;
      h.m[2][c] = h.m[2][c] + z * s;
    }
  }
  return h;
}

/// Forces P times slopes, times `weight`.
template <class V>
static inline void put_forces(const TetRows& rows, const Square<V>& p, const V& weight, long i) {
  Square<V> w;
  for (int r = 0; r < 3; ++r)
    for (int c = 0; c < 3; ++c) w.m[r][c] = weight * p.m[r][c];
  for (long a = 0; a < rows.nodes; ++a) {
    const long at = 3 * a * rows.stride + i;
    const V sx = load<V>(rows.slope + at), sy = load<V>(rows.slope + at + rows.stride),
            sz = load<V>(rows.slope + at + 2 * rows.stride);
    for (int r = 0; r < 3; ++r)
      store(rows.force + at + r * rows.stride, (w.m[r][0] * sx + w.m[r][1] * sy) + w.m[r][2] * sz);
  }
}

/// Newton's iteration R <- (R + R^-T) / 2. A point that has settled stays as it is while others of
/// its register go on.
template <class V>
static inline Square<V> nearest_turn(const Square<V>& f) {
  constexpr int kMost = 20;
  constexpr double kFlat = 1e-9, kSettled = 1e-28;
  Square<V> r = f;
  const V none = f.m[0][0] * 0;
  V going = none + 1.0, sound = none;
  for (int n = 0; n < kMost; ++n) {
    Square<V> c;
    for (int a = 0; a < 3; ++a) {
      const int b = (a + 1) % 3, d = (a + 2) % 3;
      for (int k = 0; k < 3; ++k) {
        const int p = (k + 1) % 3, q = (k + 2) % 3;
        c.m[a][k] = r.m[b][p] * r.m[d][q] - r.m[b][q] * r.m[d][p];
      }
    }
    const V det = (r.m[0][0] * c.m[0][0] + r.m[0][1] * c.m[0][1]) + r.m[0][2] * c.m[0][2];
    if (n == 0) {
      sound = det > none + kFlat ? none + 1.0 : none;
      going = sound;
    }
    const V half = 0.5 / (going > none ? det : none + 1.0);
    V change = none;
    for (int a = 0; a < 3; ++a)
      for (int k = 0; k < 3; ++k) {
        const V next = 0.5 * r.m[a][k] + half * c.m[a][k], by = next - r.m[a][k];
        change = change + by * by;
        r.m[a][k] = going > none ? next : r.m[a][k];
      }
    going = change < none + kSettled ? none : going;
    bool any = false;
    for (long k = 0; k < kLanes<V>; ++k) any = any || going[k] > 0;
    if (!any) break;
  }
  for (auto& row : r.m)
    for (V& e : row) e = sound > none ? e : none;
  return r;
}

/// R times Hooke's stress of the symmetric part of R^T h (+ R^T - 1: the strain of the place
/// itself; so written, no digits are lost where h is small).
template <class V>
static inline Square<V> turned_stress(const Square<V>& h, const Square<V>* turn, bool of_place,
                                      const TetModuli& by) {
  Square<V> e = h;
  if (turn)
    for (int r = 0; r < 3; ++r)
      for (int c = 0; c < 3; ++c) {
        e.m[r][c] =
            (turn->m[0][r] * h.m[0][c] + turn->m[1][r] * h.m[1][c]) + turn->m[2][r] * h.m[2][c];
        if (of_place) e.m[r][c] = e.m[r][c] + (r == c ? turn->m[c][r] - 1.0 : turn->m[c][r]);
      }
  const V trace = by.lambda * ((e.m[0][0] + e.m[1][1]) + e.m[2][2]);
  Square<V> s;
  for (int r = 0; r < 3; ++r) {
    s.m[r][r] = (2 * by.mu) * e.m[r][r] + trace;
    for (int c = 0; c < r; ++c) s.m[r][c] = s.m[c][r] = by.mu * (e.m[r][c] + e.m[c][r]);
  }
  if (!turn) return s;
  Square<V> p;
  for (int r = 0; r < 3; ++r)
    for (int c = 0; c < 3; ++c)
      p.m[r][c] =
          (turn->m[r][0] * s.m[0][c] + turn->m[r][1] * s.m[1][c]) + turn->m[r][2] * s.m[2][c];
  return p;
}

template <class V>
static inline void rotate_rows(const TetRows& rows, const double* v) {
  for (long i = 0; i < rows.count; i += kLanes<V>) {
    Square<V> f = gradient_at<V>(rows, v, i);
    for (int k = 0; k < 3; ++k) f.m[k][k] = f.m[k][k] + 1.0;
    put_square(rows.turn + i, rows.stride, nearest_turn(f));
  }
}

template <class V>
static inline void stress_rows(const TetRows& rows, const TetModuli& by, const double* v,
                               double factor, bool of_place) {
  for (long i = 0; i < rows.count; i += kLanes<V>) {
    const Square<V> h = gradient_at<V>(rows, v, i);
    const V weight = factor * load<V>(rows.volume + i);
    if (rows.turn) {
      const Square<V> turn = square_at<V>(rows.turn + i, rows.stride);
      put_forces(rows, turned_stress(h, &turn, of_place, by), weight, i);
    } else {
      put_forces(rows, turned_stress<V>(h, nullptr, of_place, by), weight, i);
    }
  }
}

template <class V>
static inline void elastic_rows(const TetRows& rows, const TetModuli& by, const double* v,
                                double factor) {
  stress_rows<V>(rows, by, v, -factor, true);
}
template <class V>
static inline void stiffness_rows(const TetRows& rows, const TetModuli& by, const double* v,
                                  double factor) {
  stress_rows<V>(rows, by, v, factor, false);
}

template <class V>
static inline void neo_hookean_rows(const TetRows& rows, const TetModuli& by, const double* v) {
  for (long i = 0; i < rows.count; i += kLanes<V>) {
    const Square<V> h = gradient_at<V>(rows, v, i);
    const hex::Deformation<V> d =
        hex::deform<V>(h.m[0][0], h.m[0][1], h.m[0][2], h.m[1][0], h.m[1][1], h.m[1][2], h.m[2][0],
                       h.m[2][1], h.m[2][2]);
    const hex::StressFactors<V> s = hex::neo_hookean(d, by.mu, by.bulk);
    const Square<V> p = {
        {{s.f * d.fxx + s.cof * d.cxx, s.f * d.fxy + s.cof * d.cxy, s.f * d.fxz + s.cof * d.cxz},
         {s.f * d.fyx + s.cof * d.cyx, s.f * d.fyy + s.cof * d.cyy, s.f * d.fyz + s.cof * d.cyz},
         {s.f * d.fzx + s.cof * d.czx, s.f * d.fzy + s.cof * d.czy, s.f * d.fzz + s.cof * d.czz}}};
    put_forces(rows, p, -load<V>(rows.volume + i), i);
  }
}

template <class V>
static inline void nearest_rows(double* matrix, long count, long stride) {
  for (long i = 0; i < count; i += kLanes<V>)
    put_square(matrix + i, stride, nearest_turn(square_at<V>(matrix + i, stride)));
}

/// Sum of products in eight parts, added in this order whatever the registers.
template <class V>
static inline double product_sum(const double* a, const double* b, long n) {
  constexpr long kParts = kRegister / kLanes<V>;
  double sum = 0;
  long i = 0;
  if (n >= kRegister) {
    V s[kParts];
    for (long p = 0; p < kParts; ++p)
      s[p] = load<V>(a + p * kLanes<V>) * load<V>(b + p * kLanes<V>);
    for (i = kRegister; i + kRegister <= n; i += kRegister)
      for (long p = 0; p < kParts; ++p)
        s[p] = s[p] + load<V>(a + i + p * kLanes<V>) * load<V>(b + i + p * kLanes<V>);
    const auto part = [&](long k) { return s[k / kLanes<V>][k % kLanes<V>]; };
    sum = ((part(0) + part(1)) + (part(2) + part(3))) + ((part(4) + part(5)) + (part(6) + part(7)));
  }
  for (; i < n; ++i) sum += a[i] * b[i];
  return sum;
}

template <class V>
static inline void forward_rows(const TetProfile& p, double* x) {
  for (long i = 0; i < p.size; ++i) {
    const long first = p.first[i];
    x[i] -= product_sum<V>(p.values + p.start[i], x + first, i - first);
  }
}

template <class V>
static inline void back_rows(const TetProfile& p, double* x) {
  for (long i = p.size; i-- > 0;) {
    const double* row = p.values + p.start[i];
    double* to = x + p.first[i];
    const double by = x[i];
    const long n = i - static_cast<long>(p.first[i]);
    long k = 0;
    for (; k + kLanes<V> <= n; k += kLanes<V>)
      store(to + k, load<V>(to + k) - load<V>(row + k) * by);
    for (; k < n; ++k) to[k] -= row[k] * by;
  }
}

template <class V>
inline constexpr TetWork kTetWork = {rotate_rows<V>,      elastic_rows<V>, stiffness_rows<V>,
                                     neo_hookean_rows<V>, nearest_rows<V>, forward_rows<V>,
                                     back_rows<V>};

}  // namespace osteon::tets
