#pragma once

#include "osteon/image/volume.h"

namespace osteon {

/// Distance of each voxel of the mask to the nearest voxel centre outside it, m; 0 outside. Exact,
/// on grids of any spacing (Felzenszwalb and Huttenlocher, Theory of Computing 8, 2012). Beyond the
/// grid counts as inside.
Grid<float> distance_map(const Mask& mask);

}  // namespace osteon
