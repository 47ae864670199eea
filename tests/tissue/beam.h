#pragma once

#include <cmath>
#include <numbers>

#include "osteon/tissue/solve.h"

namespace osteon::test {

/// A bar along x of square section, its low end on x = 0.
struct Bar {
  double length_m = 0.1, side_m = 0.02;
  double young_pa = 1e5, poisson = 0.3, density_kg_per_m3 = 1000;
  std::uint32_t cells_across = 4;

  double area_m2() const { return side_m * side_m; }
  double second_moment_m4() const { return std::pow(side_m, 4) / 12; }
  double cell_m() const { return side_m / cells_across; }
  double shear_pa() const { return young_pa / (2 * (1 + poisson)); }
  double bulk_pa() const { return young_pa / (3 * (1 - 2 * poisson)); }
  double mass_kg() const { return density_kg_per_m3 * area_m2() * length_m; }
};

/// Deflection of the loaded end of a cantilever by Timoshenko's beam, shear coefficient of Cowper
/// (1966) for a rectangle.
inline double timoshenko_m(const Bar& bar, double force_n) {
  const double k = 10 * (1 + bar.poisson) / (12 + 11 * bar.poisson);
  return force_n * std::pow(bar.length_m, 3) / (3 * bar.young_pa * bar.second_moment_m4()) +
         force_n * bar.length_m / (k * bar.shear_pa() * bar.area_m2());
}

/// First period of a cantilever by Euler and Bernoulli, corrected for shear and rotary inertia to
/// first order (Timoshenko): omega^2 falls by the factor 1 + 1/3 shear and rotation terms, so the
/// caller uses a slender bar where they are small.
inline double first_period_s(const Bar& bar) {
  const double beta = 1.8751040687;
  const double omega =
      beta * beta / (bar.length_m * bar.length_m) *
      std::sqrt(bar.young_pa * bar.second_moment_m4() / (bar.density_kg_per_m3 * bar.area_m2()));
  return 2 * std::numbers::pi / omega;
}

inline Aabb face_at(const Bar& bar, double x_m) {
  Aabb box;
  box.include({x_m, 0, 0});
  box.include({x_m, bar.side_m, bar.side_m});
  return box;
}

/// The bar as a grid, without supports.
inline SolveScene bar_scene(const Bar& bar, TissueModel model, double time_s) {
  SolveScene scene;
  scene.name = "bar";
  HexGrid grid;
  grid.cell_m = bar.cell_m();
  const auto along = static_cast<std::uint32_t>(std::lround(bar.length_m / grid.cell_m));
  grid.cells = {along, bar.cells_across, bar.cells_across};
  scene.body.grid = grid;
  scene.model = model;
  scene.material = {bar.young_pa, bar.poisson, bar.density_kg_per_m3, 0};
  scene.time_s = time_s;
  return scene;
}

/// Clamped at its low end, pulled down at the other; damped so that it comes to rest.
inline SolveScene cantilever(const Bar& bar, TissueModel model, double force_n) {
  const double period = first_period_s(bar);
  SolveScene scene = bar_scene(bar, model, 4 * period);
  scene.material.damping_per_s = 2 * 2 * std::numbers::pi / period;
  scene.fixed.push_back({face_at(bar, 0), {true, true, true}});
  scene.loads.push_back({face_at(bar, bar.length_m), {0, 0, -force_n}, 0.5 * period});
  scene.probes_m.push_back({bar.length_m, 0.5 * bar.side_m, 0.5 * bar.side_m});
  return scene;
}

/// Two opposite faces along x on rollers that part by `strain`, the sides free.
inline SolveScene stretched(const Bar& bar, TissueModel model, double strain) {
  const double period = 4 * bar.length_m / std::sqrt(bar.young_pa / bar.density_kg_per_m3);
  SolveScene scene = bar_scene(bar, model, 6 * period);
  scene.material.damping_per_s = 2 * 2 * std::numbers::pi / period;
  const double big = 2 * bar.length_m;
  Aabb low_y, low_z;
  low_y.include({0, 0, 0}), low_y.include({big, 0, big});
  low_z.include({0, 0, 0}), low_z.include({big, big, 0});
  scene.fixed.push_back({face_at(bar, 0), {true, false, false}});
  scene.fixed.push_back({low_y, {false, true, false}});
  scene.fixed.push_back({low_z, {false, false, true}});
  scene.moved.push_back({face_at(bar, bar.length_m),
                         {true, false, false},
                         {strain * bar.length_m, 0, 0},
                         2 * period});
  scene.probes_m.push_back({0.5 * bar.length_m, bar.side_m, bar.side_m});
  return scene;
}

/// Pull on a neo-Hookean bar whose length grows by a share, its sides free, and its stretch across:
/// from no stress across by bisection; principal stretches (a, b, b).
struct UniaxialPull {
  double force_n = 0, side_stretch = 1;
};
inline UniaxialPull uniaxial_neo_hookean(const Bar& bar, double strain) {
  const double a = 1 + strain, mu = bar.shear_pa(), bulk = bar.bulk_pa();
  const auto stress = [&](double s, double b) {
    const double j = a * b * b, i1 = a * a + 2 * b * b;
    return mu * std::pow(j, -2.0 / 3) * (s - i1 / (3 * s)) + bulk * (j - 1) * j / s;
  };
  double lo = 0.5, hi = 1.5;
  for (int n = 0; n < 100; ++n)
    (stress(0.5 * (lo + hi), 0.5 * (lo + hi)) > 0 ? hi : lo) = 0.5 * (lo + hi);
  return {stress(a, lo) * bar.area_m2(), lo};
}

}  // namespace osteon::test
