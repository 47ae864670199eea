#pragma once

#include <cstdint>

namespace osteon {

/// The resistance of a tunnel whose line a locator fixes (vKASS, section 5.2).
struct GuidedTunnel {
  double length_m = 0.035;
  double force_n = 5;  ///< F_const
  int vertices = 20;   ///< N, 3 to 64, evenly along the line
  /// Spacing of the vertices, h = L / (N - 1), m.
  double spacing_m() const { return length_m / (vertices - 1); }
};

/// What the rule of equation 2 remembers: the deepest place of the drill.
struct NaiveDrillState {
  double tunnel_m = 0;
};

/// Equation 2 and algorithm 3: the whole force whenever the drill is deeper than ever before and
/// not yet through, else none. Returns the force against the drill's direction, N.
double naive_drill_force(NaiveDrillState& state, const GuidedTunnel& tunnel, double drill_m);

/// Which vertices are drilled off: bit i of vertex i + 1.
struct RbfDrillState {
  std::uint64_t inactive = 0;
};

/// Equations 3 and 4: the sum over the active vertices but the first and the last of
/// (h - r_i) F / h where r_i = |D - c_i| < h. A vertex is drilled off when D - c_i > h. The paper
/// leaves the h in the denominator out; with it the sum is F wherever two active vertices are near,
/// which is what makes equation 4 an approximation of equation 2. N, against the drill's direction.
double rbf_drill_force(RbfDrillState& state, const GuidedTunnel& tunnel, double drill_m);

}  // namespace osteon
