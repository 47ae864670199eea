#include <cmath>
#include <limits>

#include "hex/hex_cube.h"
#include "hex/hex_forces.h"
#include "hex/hex_viscous.h"

namespace osteon {
namespace {

// Leapfrog with damping taken half before and half after:
//   m (v' - v) / dt = f - c m (v' + v) / 2,   u' = u + dt v'.
struct StepFactors {
  double keep, push;
};
StepFactors step_factors(double damping_per_s, double dt) {
  const double half = 0.5 * damping_per_s * dt;
  return {(1 - half) / (1 + half), dt / (1 + half)};
}

void advance(const HexSolid& solid, double dt, SolidState& state, const HexScratch& scratch) {
  const StepFactors by = step_factors(solid.material.damping_per_s, dt);
  for (std::size_t k = 0; k < 3; ++k) {
    const double *force = scratch.force_n[k].data(), *per_mass = solid.per_mass.data();
    double *v = state.velocity_m_per_s[k].data(), *u = state.moved_m[k].data();
    for (std::size_t s = 0; s < solid.slots; ++s) {
      v[s] = by.keep * v[s] + by.push * (per_mass[s] * force[s]);
      u[s] += dt * v[s];
    }
  }
}

// Held axes go where they are told; what the forces made of them is overwritten.
void place_held(const Supports& supports, double dt, double then_s, SolidState& state) {
  for (const HeldAxis& held : supports.held) {
    const double before = smooth_ramp(then_s - dt, held.over_s).share;
    const double now = smooth_ramp(then_s, held.over_s).share;
    state.moved_m[held.axis][held.slot] = held.to_m * now;
    state.velocity_m_per_s[held.axis][held.slot] = held.to_m * (now - before) / dt;
  }
}

double time_of(const SolidState& state, double dt) { return static_cast<double>(state.tick) * dt; }

double hourglass_square(const hex::Modes<double>& m) {
  return m.xy * m.xy + m.xz * m.xz + m.yz * m.yz + m.xyz * m.xyz;
}

void add_elastic_energy(const HexSolid& solid, const SolidState& state, SolidEnergy& sum) {
  const hex::RowConstants k = row_constants(solid);
  const double volume = std::pow(solid.grid.cell_m, 3);
  for (std::size_t s = 0; s < solid.slots; ++s) {
    if (!(solid.fill[s] > 0)) continue;
    const hex::Cube m = hex::cube_at(solid, state, s);
    sum.strain_j += solid.fill[s] * volume *
                    hex::neo_hookean_energy(hex::deformation(m, k.per_edge), k.shear_pa, k.bulk_pa);
    sum.hourglass_j += solid.fill[s] * 0.5 * k.hourglass *
                       (hourglass_square(m.x) + hourglass_square(m.y) + hourglass_square(m.z));
  }
}

// Half the mass times the velocities half a step before and after: with these the energy of a
// linear body stays the same to the last bits.
double centred_kinetic_j(const HexSolid& solid, const Supports& supports, double dt,
                         const SolidState& state, const HexScratch& scratch) {
  SolidState next = state;
  advance(solid, dt, next, scratch);
  place_held(supports, dt, time_of(state, dt) + dt, next);
  double sum = 0;
  for (std::size_t k = 0; k < 3; ++k)
    for (std::size_t s = 0; s < solid.slots; ++s)
      sum += 0.5 * solid.mass_kg[s] * state.velocity_m_per_s[k][s] * next.velocity_m_per_s[k][s];
  return sum;
}

}  // namespace

void step(const HexSolid& solid, const Supports& supports, double step_s, SolidState& state,
          HexScratch& scratch) {
  const double now_s = time_of(state, step_s);
  relax(solid, step_s, state);
  reckon_forces(solid, supports, now_s, state, scratch);
  advance(solid, step_s, state, scratch);
  ++state.tick;
  place_held(supports, step_s, time_of(state, step_s), state);
}

SolidEnergy energy(const HexSolid& solid, const Supports& supports, double step_s,
                   const SolidState& state, HexScratch& scratch) {
  SolidEnergy sum;
  add_elastic_energy(solid, state, sum);
  reckon_forces(solid, supports, time_of(state, step_s), state, scratch);
  sum.kinetic_j = centred_kinetic_j(solid, supports, step_s, state, scratch);
  return sum;
}

std::vector<Vec3> reactions(const HexSolid& solid, const Supports& supports, double step_s,
                            const SolidState& state, HexScratch& scratch) {
  std::vector<Vec3> sum(supports.entries, Vec3::Zero());
  const double now_s = time_of(state, step_s);
  reckon_forces(solid, supports, now_s, state, scratch);
  for (const HeldAxis& held : supports.held) {
    const Ramp ramp = smooth_ramp(now_s, held.over_s);
    const double mass = solid.mass_kg[held.slot];
    const double driven =
        mass * held.to_m * (ramp.per_s2 + solid.material.damping_per_s * ramp.per_s);
    sum[held.entry][held.axis] += driven - scratch.force_n[held.axis][held.slot];
  }
  return sum;
}

std::optional<LostElement> find_lost(const HexSolid& solid, const SolidState& state) {
  constexpr double kLeastRatio = 0.05;
  const double per_edge = 1 / (4 * solid.grid.cell_m);
  std::size_t s = 0;
  for (; s < solid.slots; ++s) {
    if (!(solid.fill[s] > 0)) continue;
    const double j = hex::deformation(hex::cube_at(solid, state, s), per_edge).j;
    if (j >= kLeastRatio && j < std::numeric_limits<double>::infinity()) continue;
    const auto at = solid.place(s);
    const auto& n = solid.grid.cells;
    return LostElement{at[0] + n[0] * (at[1] + n[1] * at[2]),
                       solid.rest_W(s) + Vec3::Constant(0.5 * solid.grid.cell_m), j};
  }
  return std::nullopt;
}

}  // namespace osteon
