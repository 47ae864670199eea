#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "osteon/base/result.h"
#include "osteon/base/types.h"
#include "osteon/tissue/solid_material.h"
#include "osteon/tissue/solid_state.h"
#include "osteon/tissue/supports.h"

namespace osteon {

/// Cubes side by side along the World axes.
struct HexGrid {
  std::array<std::uint32_t, 3> cells{1, 1, 1};
  double cell_m = 0.004;
  Vec3 origin_W = Vec3::Zero();  ///< the corner of lowest coordinates
};

inline constexpr std::uint32_t kMostCellsAlong = 1000;
inline constexpr std::size_t kMostHexahedra = 4'000'000;

struct HexSolidDef {
  HexGrid grid;
  SolidMaterial material;
  /// Of each cell (x fastest), how much of it is solid: 0 (none) to 1. Empty: all of every cell.
  std::vector<double> fill;
};

/// A hyperelastic solid of equal cubes, made once. Nodes lie in rows along the longest axis, each
/// row padded to whole vector registers: a node's place in the arrays is its slot.
struct HexSolid {
  HexGrid grid;
  SolidMaterial material;
  std::array<std::size_t, 3> axis{0, 1, 2};  ///< World axis of a row, of rows, of layers
  std::array<std::size_t, 3> cells{};        ///< along these
  std::size_t row_stride = 0;                ///< slots from one row of nodes to the next
  std::size_t layer_stride = 0;
  std::size_t slots = 0;
  std::size_t elements = 0;          ///< cells that are not empty
  std::vector<std::uint32_t> nodes;  ///< slots of the nodes of these cells, x fastest
  std::vector<double> mass_kg;       ///< by slot; 0 where there is no node
  std::vector<double> per_mass;      ///< 1/kg; 0 where there is no node
  std::vector<double> fill;  ///< by the slot of a cell's lowest corner; 0 where there is none

  std::size_t slot(std::size_t x, std::size_t y, std::size_t z) const;
  /// Grid coordinates of a slot.
  std::array<std::size_t, 3> place(std::size_t slot) const;
  Vec3 rest_W(std::size_t slot) const;
};

/// Fails on a grid without cells, one too large, a cell size or fill that is not sound.
Result<HexSolid> make_hex_solid(const HexSolidDef& def);

/// A step that is stable with a margin for large strains: 0.35 of the time of a pressure wave
/// through a cell (Courant, Friedrichs, Lewy; cubes of one point at rest are stable up to the
/// whole).
double stable_step_s(const HexSolid& solid);

/// Memory that a step works in: make one and keep it; it carries nothing from step to step.
struct HexScratch {
  SolidState::Field force_n;
  std::vector<double> row;
  std::vector<double> lowest_j;  ///< lowest volume ratio seen in each place of a row
};

SolidState rest_state(const HexSolid& solid);

/// One explicit step: total Lagrangian hexahedra (Miller, Joldes, Lance, Wittek 2007) of one
/// integration point, neo-Hookean
///   W = mu/2 (J^(-2/3) I1 - 3) + K/2 (J - 1)^2,
/// with stiffness control of the hourglass modes, by leapfrog. The same bits on every compiler and
/// with every register width.
void step(const HexSolid& solid, const Supports& supports, double step_s, SolidState& state,
          HexScratch& scratch);

SolidEnergy energy(const HexSolid& solid, const Supports& supports, double step_s,
                   const SolidState& state, HexScratch& scratch);

/// Force of each support on the body, newtons, by entry.
std::vector<Vec3> reactions(const HexSolid& solid, const Supports& supports, double step_s,
                            const SolidState& state, HexScratch& scratch);

/// The first cell that is turned inside out, squeezed below a twentieth of its volume or not
/// finite; none when the state is sound.
struct LostElement {
  std::size_t element = 0;  ///< grids: cell, x fastest; tetrahedra: its number
  Vec3 rest_W = Vec3::Zero();
  double volume_ratio = 0;
};
std::optional<LostElement> find_lost(const HexSolid& solid, const SolidState& state);

}  // namespace osteon
