#include "osteon/tissue/solid_material.h"

#include <cmath>

namespace osteon {
namespace {

bool above_zero(double x) { return std::isfinite(x) && x > 0; }

Result<void> check_prony(const std::vector<PronyTerm>& terms) {
  double sum = 0;
  bool sound = terms.size() <= kMostPronyTerms;
  for (const PronyTerm& term : terms) {
    sound = sound && term.g >= 0 && above_zero(term.tau_s);
    sum += term.g;
  }
  if (sound && sum < 1) return {};
  return fail("must be " + std::to_string(kMostPronyTerms) +
                  " terms at most, each g 0 or more, tau_s above 0, all g together below 1",
              "material.prony", "Give the shares of the shear modulus that are lost, and how fast");
}

}  // namespace

double shear_modulus_pa(const SolidMaterial& m) { return m.young_pa / (2 * (1 + m.poisson)); }

double bulk_modulus_pa(const SolidMaterial& m) { return m.young_pa / (3 * (1 - 2 * m.poisson)); }

double wave_speed_m_per_s(const SolidMaterial& m) {
  return std::sqrt((bulk_modulus_pa(m) + 4.0 / 3 * shear_modulus_pa(m)) / m.density_kg_per_m3);
}

Result<void> check_material(const SolidMaterial& m) {
  if (!above_zero(m.young_pa))
    return fail("must be a number above 0", "material.young_kpa", "Give Young's modulus in kPa");
  if (!(m.poisson >= 0 && m.poisson < 0.5))
    return fail("must lie from 0 to below 0.5", "material.poisson",
                "Use 0.49 or 0.499 for a nearly incompressible material");
  if (!above_zero(m.density_kg_per_m3))
    return fail("must be a number above 0", "material.density_kg_per_m3", "Water has 1000");
  if (!(std::isfinite(m.damping_per_s) && m.damping_per_s >= 0))
    return fail("must be 0 or more", "material.damping_per_s", "Use 0 for none");
  return check_prony(m.prony);
}

}  // namespace osteon
