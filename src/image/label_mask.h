#pragma once

#include <cstddef>

#include "osteon/image/volume.h"

namespace osteon {

/// Voxels of `box` for whose place in the whole grid's memory `inside` is true.
template <class F>
Mask mask_over(const LabelVolume& labels, const VoxelBox& box, F inside) {
  Mask mask;
  mask.frame = cropped(labels.frame, box);
  mask.values.reserve(mask.frame.count());
  for (int k = box.lo[2]; k < box.hi[2]; ++k)
    for (int j = box.lo[1]; j < box.hi[1]; ++j) {
      const std::size_t row = labels.frame.index(box.lo[0], j, k);
      const auto width = static_cast<std::size_t>(box.hi[0] - box.lo[0]);
      for (std::size_t n = row; n < row + width; ++n) mask.values.push_back(inside(n) ? 1 : 0);
    }
  return mask;
}

/// Calls `visit(begin, end, j, k)` for each run of set voxels, begin <= i < end.
template <class F>
void each_run(const Mask& mask, F visit) {
  const int width = mask.frame.size[0];
  for (int k = 0; k < mask.frame.size[2]; ++k)
    for (int j = 0; j < mask.frame.size[1]; ++j)
      for (int i = 0; i < width;) {
        int end = i;
        while (end < width && mask.at(end, j, k) != 0) ++end;
        if (end > i) visit(i, end, j, k);
        i = end + 1;
      }
}

}  // namespace osteon
