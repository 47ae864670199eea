#pragma once

#include <span>

#include "osteon/base/types.h"

namespace osteon {

/// Distance of a point to the way through the places, straight from each to the next, m; to the
/// place itself where there is one; infinite where there is none.
double distance_to_polyline(std::span<const Vec3> places, const Vec3& p);

}  // namespace osteon
