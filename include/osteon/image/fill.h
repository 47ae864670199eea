#pragma once

#include "osteon/image/volume.h"

namespace osteon {

/// Fills what a mask encloses. A body that the grid's rim cuts through is closed there first: on
/// each face of the grid, what is enclosed within that face is filled too, up to 15 cm2.
void fill_holes(Mask& mask);

}  // namespace osteon
