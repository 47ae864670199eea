#include "osteon/tissue/hex_solid.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "hex/hex_kernel.h"

namespace osteon {
namespace {

Result<void> check_grid(const HexGrid& grid) {
  std::size_t count = 1;
  for (const std::uint32_t n : grid.cells) {
    if (n < 1 || n > kMostCellsAlong)
      return fail("each count must be a whole number from 1 to " + std::to_string(kMostCellsAlong),
                  "mesh.grid.cells", "Give the cells along x, y and z");
    count *= n;
  }
  if (count > kMostHexahedra)
    return fail(std::to_string(count) + " cells are more than " + std::to_string(kMostHexahedra),
                "mesh.grid.cells", "Use fewer, larger cells");
  if (!(std::isfinite(grid.cell_m) && grid.cell_m >= 1e-6 && grid.cell_m <= 1))
    return fail("must lie between 0.001 and 1000", "mesh.grid.cell_mm", "Give the edge of a cell");
  if (!is_finite(grid.origin_W))
    return fail("must be three finite numbers", "mesh.grid.origin_mm", "Give a corner in mm");
  return {};
}

Result<void> check_fill(const HexSolidDef& def) {
  if (def.fill.empty()) return {};
  const auto& n = def.grid.cells;
  bool any = false, sound = def.fill.size() == std::size_t{n[0]} * n[1] * n[2];
  for (const double f : def.fill) {
    sound = sound && f >= 0 && f <= 1;
    any = any || f > 0;
  }
  if (sound && any) return {};
  return fail("each cell needs a fill from 0 to 1, and some must be above 0", "fill",
              "Give one number per cell");
}

std::size_t round_up(std::size_t n, std::size_t to) { return (n + to - 1) / to * to; }

// The longest axis along the rows, where registers fill best.
void lay_out(HexSolid& solid) {
  const auto& n = solid.grid.cells;
  std::stable_sort(solid.axis.begin(), solid.axis.end(),
                   [&](std::size_t a, std::size_t b) { return n[a] > n[b]; });
  for (std::size_t k = 0; k < 3; ++k) solid.cells[k] = n[solid.axis[k]];
  solid.row_stride = round_up(solid.cells[0], hex::kRegister) + 1;
  solid.layer_stride = solid.row_stride * (solid.cells[1] + 1);
  solid.slots = solid.layer_stride * (solid.cells[2] + 1);
}

void spread_masses(HexSolid& solid, const HexSolidDef& def) {
  const auto& n = solid.grid.cells;
  const double corner_kg = solid.material.density_kg_per_m3 * std::pow(solid.grid.cell_m, 3) / 8;
  std::size_t cell = 0;
  for (std::size_t z = 0; z < n[2]; ++z)
    for (std::size_t y = 0; y < n[1]; ++y)
      for (std::size_t x = 0; x < n[0]; ++x, ++cell) {
        const double fill = def.fill.empty() ? 1 : def.fill[cell];
        if (!(fill > 0)) continue;
        solid.fill[solid.slot(x, y, z)] = fill;
        ++solid.elements;
        for (std::size_t k = 0; k < 8; ++k)
          solid.mass_kg[solid.slot(x + k % 2, y + k / 2 % 2, z + k / 4)] += fill * corner_kg;
      }
}

void list_nodes(HexSolid& solid) {
  const auto& n = solid.grid.cells;
  for (std::size_t z = 0; z <= n[2]; ++z)
    for (std::size_t y = 0; y <= n[1]; ++y)
      for (std::size_t x = 0; x <= n[0]; ++x) {
        const std::size_t s = solid.slot(x, y, z);
        if (!(solid.mass_kg[s] > 0)) continue;
        solid.nodes.push_back(static_cast<std::uint32_t>(s));
        solid.per_mass[s] = 1 / solid.mass_kg[s];
      }
}

}  // namespace

std::size_t HexSolid::slot(std::size_t x, std::size_t y, std::size_t z) const {
  const std::array<std::size_t, 3> at{x, y, z};
  return at[axis[0]] + at[axis[1]] * row_stride + at[axis[2]] * layer_stride;
}

std::array<std::size_t, 3> HexSolid::place(std::size_t s) const {
  std::array<std::size_t, 3> at{};
  at[axis[2]] = s / layer_stride;
  at[axis[1]] = s % layer_stride / row_stride;
  at[axis[0]] = s % row_stride;
  return at;
}

Vec3 HexSolid::rest_W(std::size_t s) const {
  const auto at = place(s);
  return grid.origin_W + grid.cell_m * Vec3(static_cast<double>(at[0]), static_cast<double>(at[1]),
                                            static_cast<double>(at[2]));
}

Result<HexSolid> make_hex_solid(const HexSolidDef& def) {
  for (const auto& checked : {check_grid(def.grid), check_material(def.material), check_fill(def)})
    if (!checked) return tl::unexpected(checked.error());
  HexSolid solid;
  solid.grid = def.grid;
  solid.material = def.material;
  lay_out(solid);
  solid.fill.assign(solid.slots, 0.0);
  solid.mass_kg.assign(solid.slots, 0.0);
  solid.per_mass.assign(solid.slots, 0.0);
  spread_masses(solid, def);
  list_nodes(solid);
  return solid;
}

double stable_step_s(const HexSolid& solid) {
  return 0.35 * solid.grid.cell_m / wave_speed_m_per_s(solid.material);
}

SolidState rest_state(const HexSolid& solid) {
  SolidState state = state_at_rest(solid.slots, false);
  state.lost_pa.assign(6 * solid.material.prony.size() * solid.slots, 0.0);
  return state;
}

}  // namespace osteon
