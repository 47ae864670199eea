#pragma once

#include "collide/exact_oracle.h"

namespace osteon::exact {

/// Hit (touching included) by CGAL's exact simplex solver over both bodies' facets.
bool solve_hit(const Body& a, const Body& b, const Turn& X_AB);

}  // namespace osteon::exact
