#include "hex/hex_forces.h"

#include "hex/hex_viscous.h"

namespace osteon {
namespace {

void prepare(const HexSolid& solid, HexScratch& scratch) {
  const std::size_t count = solid.row_stride - 1;
  if (scratch.row.size() == hex::kOutputs * count && scratch.force_n[0].size() == solid.slots)
    return;
  for (auto& force : scratch.force_n) force.assign(solid.slots, 0.0);
  scratch.row.assign(hex::kOutputs * count, 0.0);
  scratch.lowest_j.assign(count, 1.0);
}

void start_with_weight(const HexSolid& solid, const Vec3& gravity, HexScratch& scratch) {
  for (std::size_t k = 0; k < 3; ++k) {
    const double g = gravity[static_cast<Eigen::Index>(k)];
    double* force = scratch.force_n[k].data();
    const double* mass = solid.mass_kg.data();
    for (std::size_t s = 0; s < solid.slots; ++s) force[s] = g * mass[s];
  }
}

void add_loads(const Supports& supports, double time_s, HexScratch& scratch) {
  for (const NodeLoad& load : supports.loads) {
    const double share = smooth_ramp(time_s, load.over_s).share;
    for (std::size_t k = 0; k < 3; ++k)
      scratch.force_n[k][load.slot] += share * load.force_n[static_cast<Eigen::Index>(k)];
  }
}

}  // namespace

hex::RowConstants row_constants(const HexSolid& solid) {
  const double h = solid.grid.cell_m, mu = shear_modulus_pa(solid.material);
  // A mode's sum over the corners is eight times its amplitude, and so is its force.
  const double hourglass = 4.0 / 3 * kHourglass * mu * h / 64;
  return {1 / (4 * h), h * h / 4, mu, bulk_modulus_pa(solid.material), hourglass};
}

void reckon_forces(const HexSolid& solid, const Supports& supports, double time_s,
                   const SolidState& state, HexScratch& scratch) {
  prepare(solid, scratch);
  start_with_weight(solid, supports.gravity_m_per_s2, scratch);
  const hex::RowConstants constants = row_constants(solid);
  const hex::RowWork work = hex::best_row_work();
  hex::Row row{};
  row.work = scratch.row.data();
  row.lowest_j = scratch.lowest_j.data();
  row.count = static_cast<long>(solid.row_stride - 1);
  for (std::size_t layer = 0; layer < solid.cells[2]; ++layer)
    for (std::size_t line = 0; line < solid.cells[1]; ++line) {
      const std::size_t first = layer * solid.layer_stride + line * solid.row_stride;
      const std::array<std::size_t, 4> at{first, first + solid.row_stride,
                                          first + solid.layer_stride,
                                          first + solid.layer_stride + solid.row_stride};
      for (std::size_t k = 0; k < 3; ++k)
        for (std::size_t r = 0; r < 4; ++r) {
          row.moved[k][r] = state.moved_m[solid.axis[k]].data() + at[r];
          row.force[k][r] = scratch.force_n[solid.axis[k]].data() + at[r];
        }
      row.fill = solid.fill.data() + first;
      work(constants, row);
    }
  add_viscous_forces(solid, state, scratch.force_n);
  add_loads(supports, time_s, scratch);
}

}  // namespace osteon
