#pragma once

#include "hex/hex_element.h"
#include "osteon/tissue/hex_solid.h"

// One cube of a solid, read from its state: for the reports and for what is done cube by cube.

namespace osteon::hex {

/// Sums of the corners' ways along rows, lines, layers.
struct Cube {
  Modes<double> x, y, z;
};

inline Modes<double> modes_of(const std::vector<double>& u, const HexSolid& solid, std::size_t s) {
  const std::size_t b = s + solid.row_stride, c = s + solid.layer_stride, d = c + solid.row_stride;
  return to_modes(u[s], u[s + 1], u[b], u[b + 1], u[c], u[c + 1], u[d], u[d + 1]);
}

/// Of the cube whose lowest corner is `s`.
inline Cube cube_at(const HexSolid& solid, const SolidState& state, std::size_t s) {
  return {modes_of(state.moved_m[solid.axis[0]], solid, s),
          modes_of(state.moved_m[solid.axis[1]], solid, s),
          modes_of(state.moved_m[solid.axis[2]], solid, s)};
}

inline Deformation<double> deformation(const Cube& m, double per_edge) {
  return deform<double>(m.x.x * per_edge, m.x.y * per_edge, m.x.z * per_edge, m.y.x * per_edge,
                        m.y.y * per_edge, m.y.z * per_edge, m.z.x * per_edge, m.z.y * per_edge,
                        m.z.z * per_edge);
}

}  // namespace osteon::hex
