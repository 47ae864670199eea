#pragma once

// The loops over a row of cubes, compiled for each width of registers (hex_kernel.h).
//
// Symbols: h edge, F = 1 + grad u at the cube's middle, P first Piola-Kirchhoff stress, m the sums
// of the four hourglass modes. With Gamma the signs of a mode at the corners a,
//   grad_J u = sum_a Gamma_Ja u_a / (4 h),   f_a = -(h^2/4) sum_J P_J Gamma_Ja - k sum_m m
//   Gamma_ma:
// one butterfly gives all sums, its transpose scatters all forces (uniform gradient of Flanagan and
// Belytschko 1981, on a grid; total Lagrangian hourglass control as Joldes, Wittek, Miller 2009).
//
// Same bits everywhere: each cube is reckoned by itself, in the order written.

#include "hex/hex_element.h"
#include "hex/hex_kernel.h"

namespace osteon::hex {

/// Forces at the low and the high end of each of the four rows, `stride` apart.
template <class V>
static inline void put(double* out, long stride, const RowValues<V>& v) {
  store(out, v.even0 - v.odd0);
  store(out + stride, v.even0 + v.odd0);
  store(out + 2 * stride, v.even1 - v.odd1);
  store(out + 3 * stride, v.even1 + v.odd1);
  store(out + 4 * stride, v.even2 - v.odd2);
  store(out + 5 * stride, v.even2 + v.odd2);
  store(out + 6 * stride, v.even3 - v.odd3);
  store(out + 7 * stride, v.even3 + v.odd3);
}

template <class V>
static inline Modes<V> modes_at(const double* const* rows, long i) {
  return to_modes(load<V>(rows[0] + i), load<V>(rows[0] + i + 1), load<V>(rows[1] + i),
                  load<V>(rows[1] + i + 1), load<V>(rows[2] + i), load<V>(rows[2] + i + 1),
                  load<V>(rows[3] + i), load<V>(rows[3] + i + 1));
}

/// Reckons the cubes from `i` on, a register of them.
template <class V>
static inline void reckon(const RowConstants& k, const Row& row, long i) {
  const V share = load<V>(row.fill + i);
  const V nothing = share * 0;
  // An empty place keeps its shape, whatever its corners do.
  const V s = share > nothing ? nothing + k.per_edge : nothing;
  const Modes<V> mx = modes_at<V>(row.moved[0], i);
  const Modes<V> my = modes_at<V>(row.moved[1], i);
  const Modes<V> mz = modes_at<V>(row.moved[2], i);
  const Deformation<V> d = deform<V>(mx.x * s, mx.y * s, mx.z * s, my.x * s, my.y * s, my.z * s,
                                     mz.x * s, mz.y * s, mz.z * s);
  const V lowest = load<V>(row.lowest_j + i);
  store(row.lowest_j + i, d.j < lowest ? d.j : lowest);
  const StressFactors<V> p = neo_hookean(d, k.shear_pa, k.bulk_pa);
  const V face = -k.face * share;
  const V pf = face * p.f, pc = face * p.cof, q = -k.hourglass * share;
  put(row.work + i, row.count,
      from_modes<V>({pf * d.fxx + pc * d.cxx, pf * d.fxy + pc * d.cxy, pf * d.fxz + pc * d.cxz,
                     q * mx.xy, q * mx.xz, q * mx.yz, q * mx.xyz}));
  put(row.work + 8 * row.count + i, row.count,
      from_modes<V>({pf * d.fyx + pc * d.cyx, pf * d.fyy + pc * d.cyy, pf * d.fyz + pc * d.cyz,
                     q * my.xy, q * my.xz, q * my.yz, q * my.xyz}));
  put(row.work + 16 * row.count + i, row.count,
      from_modes<V>({pf * d.fzx + pc * d.czx, pf * d.fzy + pc * d.czy, pf * d.fzz + pc * d.czz,
                     q * mz.xy, q * mz.xz, q * mz.yz, q * mz.xyz}));
}

template <class V>
static inline void add_to(double* force, const double* values, long count) {
  for (long i = 0; i < count; i += kLanes<V>)
    store(force + i, load<V>(force + i) + load<V>(values + i));
}

template <class V>
static inline void work_on_row(const RowConstants& constants, const Row& row) {
  for (long i = 0; i < row.count; i += kLanes<V>) reckon<V>(constants, row, i);
  for (int axis = 0; axis < 3; ++axis)
    for (int r = 0; r < 4; ++r) {
      const double* low = row.work + (8 * axis + 2 * r) * row.count;
      add_to<V>(row.force[axis][r], low, row.count);
      add_to<V>(row.force[axis][r] + 1, low + row.count, row.count);
    }
}

}  // namespace osteon::hex
