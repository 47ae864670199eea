#pragma once

#include "osteon/tissue/hex_solid.h"

namespace osteon {

/// Lets the stress that a solid of Prony terms has lost follow its shape, over a step. Nothing
/// happens where the material has no terms.
void relax(const HexSolid& solid, double step_s, SolidState& state);

/// Adds to the forces on the nodes what the lost stress makes of them.
void add_viscous_forces(const HexSolid& solid, const SolidState& state, SolidState::Field& force_n);

}  // namespace osteon
