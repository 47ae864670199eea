#pragma once

#include <span>
#include <vector>

#include "osteon/image/components.h"
#include "osteon/image/volume.h"

namespace osteon {

/// Which bright parts of a CT lie outside the body, such as a head rest, a table, a cast or a ring:
/// more than half of what lies 1 to 3 mm from them is air (below -400 HU). Of bone it is tissue.
/// Where no part lies in tissue, the scan shows dry bones, and none is outside. `labels` holds the
/// parts under their labels; what is in any of them is not looked at.
std::vector<bool> parts_outside_body(const Volume& volume, const LabelVolume& labels,
                                     std::span<const Component> parts);

}  // namespace osteon
