#pragma once

#include "osteon/base/types.h"

namespace osteon {

/// Spherical linear interpolation along the shorter arc, t in [0, 1]: halves the arc with exact
/// midpoints until it is below 4 mrad, then goes straight (error below 1e-9 rad). Unlike the usual
/// formula it calls no sine, whose last bit differs between machines.
Quat slerp(const Quat& a, const Quat& b, double t);

}  // namespace osteon
