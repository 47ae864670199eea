#pragma once

#include <cstdint>
#include <vector>

#include "osteon/image/volume.h"

namespace osteon {

struct NeckOptions {
  /// Two bodies are one when the neck between them is at least this share of the thinner one: a
  /// shaft is no joint.
  double widest_neck = 0.42;
  /// ... or when the thinner one stands out from the neck by less than this, m.
  double least_height_m = 0.0008;
};

/// Parts a body at its necks: watershed of the map of distances to its outside, flooded from the
/// deepest voxel up; where two basins meet they become one or stay apart by the height of the pass
/// (dynamics; Grimaud 1992). Returns how many parts there are; `labels` holds 1, 2, ... within the
/// body and 0 outside.
int split_at_necks(const Grid<float>& distance_m, const NeckOptions& options, LabelVolume& labels);

/// Grows the labels of `seeds` over the voxels of `mask`, brighter voxels of `height` first (marker
/// controlled watershed; Meyer 1994). Voxels that no seed reaches keep 0.
void grow_seeds(const Volume& height, const Mask& mask, LabelVolume& seeds);

}  // namespace osteon
