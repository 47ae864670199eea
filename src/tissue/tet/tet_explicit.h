#pragma once

#include <optional>
#include <vector>

#include "osteon/tissue/tet_solid.h"
#include "tet/tet_points.h"

namespace osteon {

/// Explicit steps of neo-Hookean tetrahedra,
///   W = mu/2 (J^(-2/3) I1 - 3) + K/2 (J - 1)^2,
/// by leapfrog, as of the cubes (osteon/tissue/hex_solid.h); `corotated` of the solid does not
/// matter here.

/// A step that is stable with a margin for large strains: 0.6 of twice the inverse of the quickest
/// swing at rest, which is found by power iteration.
double stable_explicit_step_s(const TetSolid& solid);

/// What a step works in: memory, and the solid's points as rows, made by the first step. For one
/// solid.
struct TetScratch {
  std::vector<Vec3> force_n, moved_m;
  std::optional<TetPointRows> points;
  TetPointScratch rows;
};

void explicit_step(const TetSolid& solid, const Supports& supports, double step_s,
                   SolidState& state, TetScratch& scratch);

/// Strain and kinetic energy, the latter by the velocities half a step before.
SolidEnergy explicit_energy(const TetSolid& solid, const SolidState& state);

/// Force of each support on the body, newtons, by entry.
std::vector<Vec3> explicit_reactions(const TetSolid& solid, const Supports& supports, double step_s,
                                     const SolidState& state, TetScratch& scratch);

/// The first element that is turned inside out, squeezed below a twentieth of its volume or not
/// finite at a point of integration.
std::optional<LostElement> find_squeezed(const TetSolid& solid, const SolidState& state);

}  // namespace osteon
