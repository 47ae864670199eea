#pragma once

#include "osteon/tissue/held_joint.h"

namespace osteon {

struct FibreForce {
  double energy_j = 0;
  double force_n = 0;
  double stiffness_n_per_m = 0;
};

/// Of a fibre of this whole length.
FibreForce fibre_force(const JointFibre& fibre, double length_m);

}  // namespace osteon
