#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "osteon/scene/soft_band.h"
#include "osteon/scene/soft_pushes.h"

namespace osteon {

/// The surface of a band at rest with a groove as deep as its strands are gone there. `section`: of
/// the band at rest.
std::vector<Vec3> notched_points(std::span<const Vec3> points_W, const SoftBand& band,
                                 const BandSpan& rest_W, const StrandAxes& section,
                                 const BandNotch& notch);

}  // namespace osteon
