#pragma once

#include <span>
#include <vector>

#include "osteon/base/types.h"
#include "osteon/scene/soft_pushes.h"

namespace osteon {

/// Where the points of a band's surface are while parts of tools bend it. The string that is felt
/// gives the middle line; the cross sections go along with it and turn with it (a generalized
/// cylinder, as vKASS 4.1.2 has it). What lies before the first end or behind the last, at the
/// footprints, stays. `rest_W`: the string with the bones at rest; all of `bends` are of this band.
std::vector<Vec3> bent_points(std::span<const Vec3> points_W, const BandSpan& rest_W,
                              std::span<const StringBend> bends);

}  // namespace osteon
