#pragma once

#include <cstdint>
#include <vector>

#include "osteon/image/volume.h"

namespace osteon {

/// Voxels begin <= i < end of row (j, k).
struct Run {
  int begin, end, j, k;
  std::uint32_t part;  ///< connected part that it belongs to
};

struct RunPart {
  std::size_t voxels = 0;
  VoxelBox box;
  bool touches_rim = false;
};

/// Connected parts (by faces) of the voxels of a mask that equal `value`, by runs and union-find:
/// parts are numbered in the order of their first voxels.
struct Parts {
  std::vector<Run> runs;
  std::vector<RunPart> parts;
};

Parts connected_parts(const Mask& mask, std::uint8_t value);

}  // namespace osteon
