#pragma once

#include <vector>

#include "osteon/base/result.h"

namespace osteon {

/// A share of the shear modulus that is lost with time: g (1 - exp(-t / tau)).
struct PronyTerm {
  double g = 0;
  double tau_s = 1;
};
inline constexpr std::size_t kMostPronyTerms = 8;

/// An isotropic elastic solid.
struct SolidMaterial {
  double young_pa = 3000;
  double poisson = 0.45;  ///< 0 to below 0.5
  double density_kg_per_m3 = 1000;
  double damping_per_s = 0;  ///< a force of -damping x mass x velocity on every node
  /// What the shear modulus loses under a lasting load; the moduli above are those at once. Only
  /// neo-Hookean hexahedra have it.
  std::vector<PronyTerm> prony = {};
};

double shear_modulus_pa(const SolidMaterial& material);
double bulk_modulus_pa(const SolidMaterial& material);
/// Speed of a pressure wave, sqrt((K + 4/3 G) / density).
double wave_speed_m_per_s(const SolidMaterial& material);

/// Fails, naming the key, on a modulus or density that is not above zero, a Poisson number outside
/// [0, 0.5), damping below zero, a value that is not finite, shares of 1 or more in all.
Result<void> check_material(const SolidMaterial& material);

}  // namespace osteon
