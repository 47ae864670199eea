#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "osteon/base/types.h"

namespace osteon {

/// All that changes of a solid: a value, saved and restored by copying. By axis and node (its slot,
/// see the solid); World axes.
struct SolidState {
  using Field = std::array<std::vector<double>, 3>;
  Field moved_m;  ///< from the rest place
  /// Explicit solids: half a step before `moved_m` (leapfrog).
  Field velocity_m_per_s;
  Field acceleration_m_per_s2;  ///< implicit solids only
  /// Solids of Prony terms: stress that each term has lost, by term, component (xx, yy, zz, xy, xz,
  /// yz, in axes of rows, lines, layers) and slot of the cell. Else empty.
  std::vector<double> lost_pa = {};
  std::uint64_t tick = 0;  ///< steps done

  Vec3 moved(std::size_t slot) const {
    return {moved_m[0][slot], moved_m[1][slot], moved_m[2][slot]};
  }
  bool operator==(const SolidState&) const = default;
};

/// A state of `slots` nodes at rest; with accelerations for an implicit solid.
SolidState state_at_rest(std::size_t slots, bool accelerations);

/// Over all of the state.
std::uint64_t hash_of(const SolidState& state);

/// False when a number of the state is not finite.
bool is_finite(const SolidState& state);

/// Energy of the velocities as they are; masses by slot.
double kinetic_j(const SolidState& state, const std::vector<double>& mass_kg);

struct SolidEnergy {
  double strain_j = 0;     ///< of the material, hourglass energy not counted
  double hourglass_j = 0;  ///< of the control of hourglass modes
  double kinetic_j = 0;
};

}  // namespace osteon
