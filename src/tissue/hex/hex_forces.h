#pragma once

#include "hex/hex_kernel.h"
#include "osteon/tissue/hex_solid.h"

namespace osteon {

/// Stiffness of the hourglass modes: the energy of a mode of amplitude q (along one axis) is
/// 1/2 (4/3) kHourglass mu h q^2. An exact cube has 1 to 3 in its modes of shear and 2 to 3 in
/// bending; 1.5 keeps both their energy and the error of a bar of four cells across small.
inline constexpr double kHourglass = 1.5;

hex::RowConstants row_constants(const HexSolid& solid);

/// Elastic forces, loads and weight at a time on every node, into scratch.force_n.
void reckon_forces(const HexSolid& solid, const Supports& supports, double time_s,
                   const SolidState& state, HexScratch& scratch);

}  // namespace osteon
