// Piercing: the force rises with the dent, breaks at a peak and falls to friction.
//
// Symbols: r radius of the tool, a radius of its hole at rest, T tension, Eh and nu of the
// membrane, q line load on the hole's rim. A hole in a wide membrane under tension T and the load q
// has the radius (Lame, plane stress)
//   r = a (1 + 2 T / Eh + (1 + nu) q / Eh),
// so a shaft meets q = Eh (r / a - 1 - 2 T / Eh) / (1 + nu), no less than 0, and slips at
// friction x 2 pi r q. A hole that a tip breaks is smaller than the tool by kHole (our assumption:
// the skin was stretched when it broke). A slit of length L goes around a shaft as a hole of radius
// L / pi, whose rim is 2 L.
//
// Rise, peak and drop are those of needles in tissue (Okamura, Simone, O'Leary 2004: stiffness
// before the puncture; friction and cutting after it). What the peak leaves over dies away with
// kDrop, so that the hand meets a fall and no step.

#include "osteon/tissue/sheet_pierce.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace osteon {
namespace {

constexpr double kHole = 0.8;      // of the tool's radius
constexpr double kDrop_s = 0.015;  // the excess halves in a little less

}  // namespace

PierceLaw pierce_law(const SheetMaterial& m, double radius_m, double cut_m,
                     double stiffness_n_per_m) {
  PierceLaw out;
  const double area = std::numbers::pi * radius_m * radius_m, broken = kHole * radius_m;
  out.hole_m = std::max(broken, std::min(cut_m / std::numbers::pi, radius_m));
  // A slit that goes around the hole to be leaves nothing to break.
  out.peak_n = m.pierce_pa * area * std::max(0.0, 1 - cut_m / (std::numbers::pi * broken));
  out.resist_n = m.fat_pierce_pa * area;
  const double load = m.stretch_n_per_m * (radius_m / out.hole_m - 1) - 2 * m.tension_n_per_m;
  out.grip_n = m.friction * 2 * std::numbers::pi * radius_m * std::max(0.0, load / (1 + m.poisson));
  out.stick_n_per_m = stiffness_n_per_m;
  return out;
}

bool pierce_step(PierceState& state, const PierceLaw& law, double depth_m, double elastic_n,
                 double step_s) {
  const double way = depth_m - state.depth_m;
  state.depth_m = depth_m;
  if (!(depth_m > 0)) {
    const bool was = state.through;
    state = {};
    state.through = was;
    return false;
  }
  if (!state.through) {
    state.force_n = elastic_n;
    if (!(elastic_n >= law.peak_n)) return false;
    state.through = true;
    state.excess_n = std::max(0.0, elastic_n - law.grip_n - law.resist_n);
    return true;
  }
  const double before = state.excess_n;
  state.excess_n = before * kDrop_s / (kDrop_s + step_s);
  const double held = state.force_n - before + law.stick_n_per_m * way;
  state.force_n = std::clamp(held, -law.grip_n, law.grip_n + law.resist_n) + state.excess_n;
  return false;
}

}  // namespace osteon
