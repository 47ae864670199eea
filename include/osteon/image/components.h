#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "osteon/image/volume.h"

namespace osteon {

inline constexpr std::size_t kMostComponents = 60000;

struct Component {
  std::uint16_t label = 0;
  std::size_t voxels = 0;
  VoxelBox box;
};

/// Labels the parts of a mask connected by faces, the largest first as 1, 2, ...; those
/// below `smallest_voxels` get no label.
std::vector<Component> label_components(const Mask& mask, std::size_t smallest_voxels,
                                        LabelVolume& labels);

}  // namespace osteon
