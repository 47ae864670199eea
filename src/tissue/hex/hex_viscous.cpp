#include "hex/hex_viscous.h"

#include <cmath>

#include "hex/hex_cube.h"
#include "hex/hex_forces.h"

// Stress that a material with Prony terms (g, tau) has lost, after Taylor, Comas, Cheng and others
// 2009 (Med Image Anal 13:234). Symbols, all in axes of rows, lines, layers: F deformation
// gradient, C = F^T F, S = mu J^(-2/3) (1 - I1/3 C^-1) the part of the second Piola-Kirchhoff
// stress that resists change of shape, A_i what term i has lost of it:
//   tau_i dA_i/dt = g_i S - A_i,   P = P(elastic) - F sum_i A_i.
// A step takes S as it is at its start and follows the equation exactly from there: A stays between
// 0 and g S for a step of any length. For a shape that is held, the shear modulus falls from mu to
// mu (1 - sum g).

namespace osteon {
namespace {

constexpr std::size_t kComponents = 6;  // xx, yy, zz, xy, xz, yz
using SixNumbers = std::array<double, kComponents>;

SixNumbers shape_stress(const hex::Deformation<double>& d, double shear_pa) {
  const double y2 = d.inv_root * d.inv_root, by = shear_pa * y2;
  const double share = d.i1 * (1.0 / 3) / (d.safe_j * d.safe_j);
  const auto inverse_c = [&](double x1, double y1, double z1, double x2, double y2_, double z2) {
    return share * (x1 * x2 + y1 * y2_ + z1 * z2);
  };
  return {by * (1 - inverse_c(d.cxx, d.cyx, d.czx, d.cxx, d.cyx, d.czx)),
          by * (1 - inverse_c(d.cxy, d.cyy, d.czy, d.cxy, d.cyy, d.czy)),
          by * (1 - inverse_c(d.cxz, d.cyz, d.czz, d.cxz, d.cyz, d.czz)),
          -by * inverse_c(d.cxx, d.cyx, d.czx, d.cxy, d.cyy, d.czy),
          -by * inverse_c(d.cxx, d.cyx, d.czx, d.cxz, d.cyz, d.czz),
          -by * inverse_c(d.cxy, d.cyy, d.czy, d.cxz, d.cyz, d.czz)};
}

double& lost_of(const HexSolid& solid, SolidState& state, std::size_t term, std::size_t c,
                std::size_t s) {
  return state.lost_pa[(term * kComponents + c) * solid.slots + s];
}

SixNumbers all_lost(const HexSolid& solid, const SolidState& state, std::size_t s) {
  SixNumbers sum{};
  for (std::size_t term = 0; term < solid.material.prony.size(); ++term)
    for (std::size_t c = 0; c < kComponents; ++c)
      sum[c] += state.lost_pa[(term * kComponents + c) * solid.slots + s];
  return sum;
}

// Forces of a stress row (P along one axis) on the corners of a cube.
void scatter_row(const HexSolid& solid, std::size_t s, const hex::Modes<double>& modes,
                 std::vector<double>& force) {
  const hex::RowValues<double> v = hex::from_modes(modes);
  const auto put = [&](std::size_t at, double even, double odd) {
    force[at] += even - odd;
    force[at + 1] += even + odd;
  };
  put(s, v.even0, v.odd0);
  put(s + solid.row_stride, v.even1, v.odd1);
  put(s + solid.layer_stride, v.even2, v.odd2);
  put(s + solid.layer_stride + solid.row_stride, v.even3, v.odd3);
}

}  // namespace

void relax(const HexSolid& solid, double step_s, SolidState& state) {
  const auto& terms = solid.material.prony;
  if (terms.empty()) return;
  const hex::RowConstants k = row_constants(solid);
  std::vector<double> keep;
  for (const PronyTerm& term : terms) keep.push_back(std::exp(-step_s / term.tau_s));
  for (std::size_t s = 0; s < solid.slots; ++s) {
    if (!(solid.fill[s] > 0)) continue;
    const SixNumbers stress =
        shape_stress(hex::deformation(hex::cube_at(solid, state, s), k.per_edge), k.shear_pa);
    for (std::size_t t = 0; t < terms.size(); ++t)
      for (std::size_t c = 0; c < kComponents; ++c) {
        double& a = lost_of(solid, state, t, c, s);
        a = keep[t] * a + (1 - keep[t]) * terms[t].g * stress[c];
      }
  }
}

void add_viscous_forces(const HexSolid& solid, const SolidState& state,
                        SolidState::Field& force_n) {
  if (solid.material.prony.empty()) return;
  const hex::RowConstants k = row_constants(solid);
  for (std::size_t s = 0; s < solid.slots; ++s) {
    if (!(solid.fill[s] > 0)) continue;
    const auto d = hex::deformation(hex::cube_at(solid, state, s), k.per_edge);
    const SixNumbers a = all_lost(solid, state, s);
    const double by = k.face * solid.fill[s];
    const auto row = [&](double fx, double fy, double fz) {
      return hex::Modes<double>{by * (fx * a[0] + fy * a[3] + fz * a[4]),
                                by * (fx * a[3] + fy * a[1] + fz * a[5]),
                                by * (fx * a[4] + fy * a[5] + fz * a[2]),
                                0,
                                0,
                                0,
                                0};
    };
    scatter_row(solid, s, row(d.fxx, d.fxy, d.fxz), force_n[solid.axis[0]]);
    scatter_row(solid, s, row(d.fyx, d.fyy, d.fyz), force_n[solid.axis[1]]);
    scatter_row(solid, s, row(d.fzx, d.fzy, d.fzz), force_n[solid.axis[2]]);
  }
}

}  // namespace osteon
