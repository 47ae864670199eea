#include "osteon/image/volume.h"

#include <algorithm>

namespace osteon {

VoxelBox grown(const VoxelBox& box, int margin, const GridFrame& frame) {
  VoxelBox out;
  for (std::size_t a = 0; a < 3; ++a) {
    out.lo[a] = std::max(0, box.lo[a] - margin);
    out.hi[a] = std::min(frame.size[a], box.hi[a] + margin);
  }
  return out;
}

GridFrame cropped(const GridFrame& frame, const VoxelBox& box) {
  GridFrame out = frame;
  for (std::size_t a = 0; a < 3; ++a) out.size[a] = box.hi[a] - box.lo[a];
  out.origin_P = frame.point_P(Vec3(box.lo[0], box.lo[1], box.lo[2]));
  return out;
}

}  // namespace osteon
