#pragma once

#include "lanes.h"

// One cube, in numbers alone: V is a double for the reports, a register of doubles for the loops
// over rows. `static`: each file that compiles these lines for its registers keeps its own copy.

namespace osteon::hex {

/// Displacements of the eight corners of a cube along one axis, as sums that change sign with
/// the corners' coordinates (Walsh-Hadamard): x, y, z are the gradient, the others the hourglass
/// modes. The mean is left out: it does no work.
template <class V>
struct Modes {
  V x, y, z, xy, xz, yz, xyz;
};

/// Corners as [low x, high x] of the rows 00, y, z, yz. Seven of the eight combinations, 23 sums.
template <class V>
static inline Modes<V> to_modes(const V& l0, const V& h0, const V& l1, const V& h1, const V& l2,
                                const V& h2, const V& l3, const V& h3) {
  const V s0 = l0 + h0, s1 = l1 + h1, s2 = l2 + h2, s3 = l3 + h3;
  const V d0 = h0 - l0, d1 = h1 - l1, d2 = h2 - l2, d3 = h3 - l3;
  const V sp = s0 + s1, sm = s1 - s0, tp = s2 + s3, tm = s3 - s2;
  const V dp = d0 + d1, dm = d1 - d0, ep = d2 + d3, em = d3 - d2;
  return {dp + ep, sm + tm, tp - sp, dm + em, ep - dp, tm - sm, em - dm};
}

/// The transpose, by rows: what is even and odd along x of the values at a row's two ends.
template <class V>
struct RowValues {
  V even0, even1, even2, even3, odd0, odd1, odd2, odd3;
};
template <class V>
static inline RowValues<V> from_modes(const Modes<V>& m) {
  const V ym = m.y - m.yz, yp = m.y + m.yz;
  const V a0 = m.x - m.xz, a1 = m.x + m.xz, b0 = m.xy - m.xyz, b1 = m.xy + m.xyz;
  return {-ym - m.z, ym - m.z, m.z - yp, m.z + yp, a0 - b0, a0 + b0, a1 - b1, a1 + b1};
}
/// y = j^(-1/3), to the last bits, from a guess within 4 %: twice the series of (1 - r)^(-1/3) up
/// to r^3 in the residual r = 1 - j y^3. Error 4e-2, then 3e-5, then below rounding.
template <class V>
static inline V improved_cube_root(const V& j, const V& guess) {
  const V r = 1.0 - j * guess * guess * guess;
  const V y = guess + guess * (r * (1.0 / 3 + r * (2.0 / 9 + r * (14.0 / 81))));
  const V t = 1.0 - j * y * y * y;
  return y + y * (t * (1.0 / 3 + t * (2.0 / 9 + t * (14.0 / 81))));
}

template <class V>
static inline V inverse_cube_root(const V& j) {
  return improved_cube_root(j, guessed_cube_root(j));
}

/// Deformation gradient F (first letter: axis moved along, second: rest axis) and what the stress
/// takes of it.
template <class V>
struct Deformation {
  V fxx, fxy, fxz, fyx, fyy, fyz, fzx, fzy, fzz;
  V cxx, cxy, cxz, cyx, cyy, cyz, czx, czy, czz;  // cofactors: J F^-T
  V j;                                            // det F
  V safe_j;    // kept above a hundredth, so that what follows is finite
  V inv_root;  // safe_j^(-1/3)
  V i1;        // |F|^2
};

template <class V>
static inline Deformation<V> deform(const V& hxx, const V& b, const V& c, const V& d, const V& hyy,
                                    const V& f, const V& g, const V& k, const V& hzz) {
  const V a = 1 + hxx, e = 1 + hyy, m = 1 + hzz;
  const V cxx = e * m - f * k, cxy = f * g - d * m, cxz = d * k - e * g;
  const V j = a * cxx + b * cxy + c * cxz;
  const V least = j * 0 + 0.01;
  const V safe_j = j > least ? j : least;
  const V i1 = ((a * a + b * b) + (c * c + d * d)) + ((e * e + f * f) + (g * g + k * k)) + m * m;
  return {a,
          b,
          c,
          d,
          e,
          f,
          g,
          k,
          m,
          cxx,
          cxy,
          cxz,
          c * k - b * m,
          a * m - c * g,
          b * g - a * k,
          b * f - c * e,
          c * d - a * f,
          a * e - b * d,
          j,
          safe_j,
          inverse_cube_root(safe_j),
          i1};
}

/// First Piola-Kirchhoff stress P = dW/dF = p_f F + p_cof cof, of the neo-Hookean energy
/// W = mu/2 (J^(-2/3) I1 - 3) + K/2 (J - 1)^2.
template <class V>
struct StressFactors {
  V f, cof;
};
template <class V>
static inline StressFactors<V> neo_hookean(const Deformation<V>& d, double shear_pa,
                                           double bulk_pa) {
  const V y2 = d.inv_root * d.inv_root;
  const V p_f = shear_pa * y2;
  return {p_f, bulk_pa * (d.safe_j - 1) - p_f * d.i1 * (1.0 / 3) * (y2 * d.inv_root)};
}

/// Energy of the neo-Hookean law for a volume of rest, J/m^3.
static inline double neo_hookean_energy(const Deformation<double>& d, double shear_pa,
                                        double bulk_pa) {
  const double part = d.safe_j - 1;
  return 0.5 * shear_pa * (d.inv_root * d.inv_root * d.i1 - 3) + 0.5 * bulk_pa * part * part;
}

}  // namespace osteon::hex
