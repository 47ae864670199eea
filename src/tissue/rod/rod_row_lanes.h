#pragma once

// The loops over the rows of a rod, compiled for each width of registers (rod_rows.h). Same bits
// everywhere: each segment is reckoned by itself, in the order written.

#include "lanes.h"
#include "rod/rod_rows.h"

namespace osteon::rods {

using hex::kLanes;
using hex::load;
using hex::store;

template <class V>
struct Three {
  V x, y, z;
};
template <class V>
struct Turn {  // a quaternion
  V x, y, z, w;
};
template <class V>
struct Nine {
  V m[3][3];
};

template <class V>
static inline V square_root(V v) {
  for (long k = 0; k < kLanes<V>; ++k) v[k] = __builtin_sqrt(v[k]);
  return v;
}

template <class V>
static inline Three<V> three_at(const double* from, long stride) {
  return {load<V>(from), load<V>(from + stride), load<V>(from + 2 * stride)};
}
template <class V>
static inline Turn<V> turn_at(const double* from, long stride) {
  return {load<V>(from), load<V>(from + stride), load<V>(from + 2 * stride),
          load<V>(from + 3 * stride)};
}
template <class V>
static inline void put_three(double* to, long stride, const Three<V>& v) {
  store(to, v.x);
  store(to + stride, v.y);
  store(to + 2 * stride, v.z);
}
template <class V>
static inline void put_nine(double* to, long stride, const Nine<V>& v) {
  for (int r = 0; r < 3; ++r)
    for (int c = 0; c < 3; ++c) store(to + (3 * r + c) * stride, v.m[r][c]);
}

/// conj(a) b, with w not negative: `sign` tells what it was turned by.
template <class V>
static inline Turn<V> between(const Turn<V>& a, const Turn<V>& b) {
  const V w = ((a.w * b.w + a.x * b.x) + a.y * b.y) + a.z * b.z;
  const V x = ((a.w * b.x - a.x * b.w) - a.y * b.z) + a.z * b.y;
  const V y = ((a.w * b.y - a.y * b.w) - a.z * b.x) + a.x * b.z;
  const V z = ((a.w * b.z - a.z * b.w) - a.x * b.y) + a.y * b.x;
  const V none = w * 0;
  const V sign = w < none ? none - 1.0 : none + 1.0;
  return {sign * x, sign * y, sign * z, sign * w};
}

/// Inertia against the turn from another frame, times `weight`: its slope.
template <class V>
static inline Three<V> turning(const Turn<V>& from, const Turn<V>& to, const V& inertia,
                               double weight) {
  const Turn<V> r = between(from, to);
  const V k = (2 * weight) * inertia;
  const V ux = k * r.x, uy = k * r.y, uz = 2.0 * (k * r.z);
  return {r.w * ux - (r.y * uz - r.z * uy), r.w * uy - (r.z * ux - r.x * uz),
          r.w * uz - (r.x * uy - r.y * ux)};
}

/// Stretch and shear of a segment. Energy l/2 G.C G with G = R^T g - e3, C = (shear, shear,
/// stretch), g = (x1 - x0) / l, h = R^T g.
///   slope: x1: R C G; turn: l (C G) x h.
///   stiffness: with d = R^T (dx1 - dx0): dG = d / l + h x w, so C / l, C [h], l [h]^T C [h]; a
///   pull T adds -T [e3] between d and w and l T (e3 e3^T - 1) to w, which together are T / l
///   across the rod when frame and segment turn as one.
/// What could make the stiffness negative is left out: bending moments that turn, and push; pull
/// that turns is kept, so that a taut rod is as stiff across as it is.
template <class V>
static inline void stretch(const RodNumbers& k, const RodRows& rows, long i, bool with_stiffness,
                           Three<V>& turn_slope, V (&turned)[6]) {
  const long n = rows.stride;
  const Turn<V> q = turn_at<V>(rows.row(kFrame) + i, n);
  const V tx = 2.0 * q.x, ty = 2.0 * q.y, tz = 2.0 * q.z;
  const V twx = tx * q.w, twy = ty * q.w, twz = tz * q.w, txx = tx * q.x, txy = ty * q.x;
  const V txz = tz * q.x, tyy = ty * q.y, tyz = tz * q.y, tzz = tz * q.z;
  const V r00 = 1.0 - (tyy + tzz), r01 = txy - twz, r02 = txz + twy;
  const V r10 = txy + twz, r11 = 1.0 - (txx + tzz), r12 = tyz - twx;
  const V r20 = txz - twy, r21 = tyz + twx, r22 = 1.0 - (txx + tyy);
  const V l = load<V>(rows.row(kLength) + i), per = load<V>(rows.row(kPerLength) + i);
  const Three<V> a = three_at<V>(rows.row(kPlace) + i, n);
  const Three<V> b = three_at<V>(rows.row(kPlace) + i + 1, n);
  const V gx = (b.x - a.x) * per, gy = (b.y - a.y) * per, gz = (b.z - a.z) * per;
  const V hx = (r00 * gx + r10 * gy) + r20 * gz;
  const V hy = (r01 * gx + r11 * gy) + r21 * gz;
  const V hz = (r02 * gx + r12 * gy) + r22 * gz;
  const V px = k.shear_n * hx, py = k.shear_n * hy, pz = k.stretch_n * (hz - 1.0);
  put_three<V>(rows.row(kPush) + i, n,
               {(r00 * px + r01 * py) + r02 * pz, (r10 * px + r11 * py) + r12 * pz,
                (r20 * px + r21 * py) + r22 * pz});
  turn_slope = {l * (py * hz - pz * hy), l * (pz * hx - px * hz), l * (px * hy - py * hx)};
  if (!with_stiffness) return;

  const V extra = (k.stretch_n - k.shear_n) * per, plain = k.shear_n * per;
  const V ex = extra * r02, ey = extra * r12, ez = extra * r22;
  const V xx[6] = {ex * r02 + plain, ey * r02, ey * r12 + plain,
                   ez * r02,         ez * r12, ez * r22 + plain};
  double* pushed = rows.row(kPushed) + i;
  for (int m = 0; m < 6; ++m) store(pushed + m * n, xx[m]);
  const Nine<V> node_node = {
      {{-xx[0], -xx[1], -xx[3]}, {-xx[1], -xx[2], -xx[4]}, {-xx[3], -xx[4], -xx[5]}}};
  put_nine<V>(rows.row(kNodeNode) + i, n, node_node);

  const V none = pz * 0, most = none + 0.5 * k.shear_n;
  V pull = pz > none ? pz : none;
  pull = pull < most ? pull : most;
  const V da = k.shear_n * hz - pull, db = py, dc = px, dd = k.stretch_n * hy,
          de = k.stretch_n * hx;
  const Nine<V> xw = {{{da * r01 - dd * r02, de * r02 - da * r00, db * r00 - dc * r01},
                       {da * r11 - dd * r12, de * r12 - da * r10, db * r10 - dc * r11},
                       {da * r21 - dd * r22, de * r22 - da * r20, db * r20 - dc * r21}}};
  put_nine<V>(rows.row(kNodeTurn) + i, n, xw);
  const Nine<V> wx = {{{-xw.m[0][0], -xw.m[1][0], -xw.m[2][0]},
                       {-xw.m[0][1], -xw.m[1][1], -xw.m[2][1]},
                       {-xw.m[0][2], -xw.m[1][2], -xw.m[2][2]}}};
  put_nine<V>(rows.row(kTurnNode) + i, n, wx);
  const V ks = k.shear_n * (hz * hz) - pull;
  turned[0] = l * (ks + k.stretch_n * (hy * hy));
  turned[1] = -(l * (k.stretch_n * (hx * hy)));
  turned[2] = l * (ks + k.stretch_n * (hx * hx));
  turned[3] = -(l * (k.shear_n * (hx * hz)));
  turned[4] = -(l * (k.shear_n * (hy * hz)));
  turned[5] = l * (k.shear_n * (hy * hy + hx * hx));
}

/// Bending and twist at the inner node between segments i and i + 1. d turn = J w1 - J^T w0 with
/// J = (1 - s^2) + 2 [s] + 2 s s^T, s = turn / 4 (Schaub, Junkins 1996).
template <class V>
static inline void bend(const RodNumbers& k, const RodRows& rows, long i, bool with_stiffness,
                        Three<V>& turn_slope, V (&turned)[6]) {
  const long n = rows.stride;
  const Turn<V> r =
      between(turn_at<V>(rows.row(kFrame) + i, n), turn_at<V>(rows.row(kFrame) + i + 1, n));
  const V to_s = 1.0 / (1.0 + r.w);
  const V x = to_s * r.x, y = to_s * r.y, z = to_s * r.z;  // a quarter of the turn
  const V per = load<V>(rows.row(kPerSpan) + i);
  const V kb = k.bend_n_m2 * per, kt = k.twist_n_m2 * per;
  const Three<V> rest = three_at<V>(rows.row(kRestTurn) + i, n);
  const V mx = kb * (4.0 * x - rest.x), my = kb * (4.0 * y - rest.y), mz = kt * (4.0 * z - rest.z);
  const V x2 = 2.0 * x, y2 = 2.0 * y, z2 = 2.0 * z;
  const V xx = x * x, yy = y * y, zz = z * z;
  const V xy = x2 * y, xz = x2 * z, yz = y2 * z;
  const V j00 = 1.0 + (xx - (yy + zz)), j11 = 1.0 + (yy - (xx + zz)), j22 = 1.0 + (zz - (xx + yy));
  const V j01 = xy - z2, j10 = xy + z2, j02 = xz + y2, j20 = xz - y2, j12 = yz - x2, j21 = yz + x2;
  put_three<V>(rows.row(kMoment) + i, n,
               {(j00 * mx + j10 * my) + j20 * mz, (j01 * mx + j11 * my) + j21 * mz,
                (j02 * mx + j12 * my) + j22 * mz});
  turn_slope.x = turn_slope.x - ((j00 * mx + j01 * my) + j02 * mz);
  turn_slope.y = turn_slope.y - ((j10 * mx + j11 * my) + j12 * mz);
  turn_slope.z = turn_slope.z - ((j20 * mx + j21 * my) + j22 * mz);
  if (!with_stiffness) return;

  const V j[3][3] = {{j00, j01, j02}, {j10, j11, j12}, {j20, j21, j22}};
  V kj[3][3], kt_j[3][3];  // stiffness times J, and times its transpose
  for (int c = 0; c < 3; ++c) {
    kj[0][c] = kb * j[0][c];
    kj[1][c] = kb * j[1][c];
    kj[2][c] = kt * j[2][c];
    kt_j[0][c] = kb * j[c][0];
    kt_j[1][c] = kb * j[c][1];
    kt_j[2][c] = kt * j[c][2];
  }
  double* next = rows.row(kTurned) + i;
  int at = 0;
  for (int a = 0; a < 3; ++a)
    for (int b = 0; b <= a; ++b, ++at) {
      store(next + at * n, (j[0][a] * kj[0][b] + j[1][a] * kj[1][b]) + j[2][a] * kj[2][b]);
      turned[at] =
          turned[at] + ((j[a][0] * kt_j[0][b] + j[a][1] * kt_j[1][b]) + j[a][2] * kt_j[2][b]);
    }
  double* across = rows.row(kTurnTurn) + i;
  for (int a = 0; a < 3; ++a)
    for (int b = 0; b < 3; ++b)
      store(across + (3 * a + b) * n,
            -((j[0][a] * kt_j[0][b] + j[1][a] * kt_j[1][b]) + j[2][a] * kt_j[2][b]));
}

/// What of segment i and node i needs no other segment.
template <class V>
static inline void reckon_own(const RodNumbers& k, const RodRows& rows, long i,
                              bool with_stiffness) {
  const long n = rows.stride;
  Three<V> turn_slope;
  V turned[6];
  stretch<V>(k, rows, i, with_stiffness, turn_slope, turned);
  bend<V>(k, rows, i, with_stiffness, turn_slope, turned);
  const Turn<V> q = turn_at<V>(rows.row(kFrame) + i, n);
  const V inertia = load<V>(rows.row(kInertia) + i);
  const Three<V> t = turning(turn_at<V>(rows.row(kAimFrame) + i, n), q, inertia, k.per_step2);
  const Three<V> d =
      turning(turn_at<V>(rows.row(kStartFrame) + i, n), q, inertia, k.damped_per_step);
  put_three<V>(
      rows.row(kSlope + 3) + i, n,
      {turn_slope.x + (t.x + d.x), turn_slope.y + (t.y + d.y), turn_slope.z + (t.z + d.z)});
  if (!with_stiffness) return;
  const V slow = (k.per_step2 + k.damped_per_step) * inertia;
  double* block = rows.row(kTurnBlock) + i;
  store(block, turned[0] + slow);
  store(block + n, turned[1]);
  store(block + 2 * n, turned[2] + slow);
  store(block + 3 * n, turned[3]);
  store(block + 4 * n, turned[4]);
  store(block + 5 * n, turned[5] + 2.0 * slow);
}

/// Adds what comes from the segment or the inner node before.
template <class V>
static inline void add_neighbours(const RodNumbers& k, const RodRows& rows, long i,
                                  bool with_stiffness) {
  const V mass = load<V>(rows.row(kMass) + i);
  const V still = k.per_step2 * mass, slow = k.damped_per_step * mass;
  for (long axis = 0; axis < 3; ++axis) {
    const V x = load<V>(rows.row(kPlace + axis) + i);
    const V own = (still * (x - load<V>(rows.row(kAimPlace + axis) + i)) +
                   slow * (x - load<V>(rows.row(kStartPlace + axis) + i))) -
                  load<V>(rows.row(kForce + axis) + i);
    const double* push = rows.row(kPush + axis) + i;
    store(rows.row(kSlope + axis) + i, own + (load<V>(push - 1) - load<V>(push)));
    double* turn = rows.row(kSlope + 3 + axis) + i;
    store(turn, load<V>(turn) + load<V>(rows.row(kMoment + axis) + i - 1));
  }
  if (!with_stiffness) return;
  for (long m = 0; m < 6; ++m) {
    const double* pushed = rows.row(kPushed + m) + i;
    V node = load<V>(pushed - 1) + load<V>(pushed);
    if (m == 0 || m == 2 || m == 5) node = node + (still + slow);
    store(rows.row(kNodeBlock + m) + i, node);
    double* block = rows.row(kTurnBlock + m) + i;
    store(block, load<V>(block) + load<V>(rows.row(kTurned + m) + i - 1));
  }
}

template <class V>
static inline void assemble_rows(const RodNumbers& k, const RodRows& rows, bool with_stiffness,
                                 long first, long last) {
  const long all = rows.segments;
  const long before = first > 0 ? first - kRowGuard : 0, end = last < all ? last : all;
  for (long i = before; i < end; i += kLanes<V>) reckon_own<V>(k, rows, i, with_stiffness);
  // Beyond the last segment nothing pushes; the other rows are zero there by their numbers.
  for (long axis = 0; axis < 3; ++axis)
    for (long i = 0; i < kRowGuard; ++i) rows.row(kPush + axis)[all + i] = 0;
  for (long i = first; i < last; i += kLanes<V>) add_neighbours<V>(k, rows, i, with_stiffness);
}

template <class V>
static inline double largest_way(const RodRows& rows, double per_radius) {
  const long n = rows.stride;
  V most = load<V>(rows.row(kWay)) * 0;
  for (long i = 0; i <= rows.segments; i += kLanes<V>) {
    const Three<V> x = three_at<V>(rows.row(kWay) + i, n),
                   w = three_at<V>(rows.row(kWay + 3) + i, n);
    const V node = ((x.x * x.x + x.y * x.y) + x.z * x.z) * (per_radius * per_radius);
    const V turn = (w.x * w.x + w.y * w.y) + w.z * w.z;
    most = node > most ? node : most;
    most = turn > most ? turn : most;
  }
  double out = 0;
  for (long k = 0; k < kLanes<V>; ++k) out = most[k] > out ? most[k] : out;
  return out;
}

template <class V>
static inline void go_on_rows(const RodRows& rows, double share, double* to) {
  const long n = rows.stride;
  for (long i = 0; i <= rows.segments; i += kLanes<V>) {
    for (long axis = 0; axis < 3; ++axis)
      store(to + axis * n + i,
            load<V>(rows.row(kPlace + axis) + i) + share * load<V>(rows.row(kWay + axis) + i));
    const Turn<V> q = turn_at<V>(rows.row(kFrame) + i, n);
    const double half = 0.5 * share;
    const V x = half * load<V>(rows.row(kWay + 3) + i), y = half * load<V>(rows.row(kWay + 4) + i),
            z = half * load<V>(rows.row(kWay + 5) + i);
    const V w = q.w - ((q.x * x + q.y * y) + q.z * z);
    const V qx = q.x + ((q.w * x + q.y * z) - q.z * y);
    const V qy = q.y + ((q.w * y + q.z * x) - q.x * z);
    const V qz = q.z + ((q.w * z + q.x * y) - q.y * x);
    const V per = 1.0 / square_root<V>((w * w + qx * qx) + (qy * qy + qz * qz));
    store(to + 3 * n + i, per * qx);
    store(to + 4 * n + i, per * qy);
    store(to + 5 * n + i, per * qz);
    store(to + 6 * n + i, per * w);
  }
}

}  // namespace osteon::rods
