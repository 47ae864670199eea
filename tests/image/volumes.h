#pragma once

#include <cmath>

#include "osteon/base/random.h"
#include "osteon/image/volume.h"

namespace osteon {

inline GridFrame small_frame() {
  GridFrame frame;
  frame.size = {9, 7, 5};
  frame.spacing_m = Vec3(0.0004, 0.0006, 0.0011);
  frame.origin_P = Vec3(-0.012, 0.034, 0.1);
  return frame;
}

/// Every voxel another value.
inline Volume noise_volume(const GridFrame& frame, std::uint64_t seed) {
  Random random(seed);
  Volume volume{frame, {}};
  for (std::size_t n = 0; n < frame.count(); ++n)
    volume.values.push_back(static_cast<std::int16_t>(std::floor(random.uniform(-1000, 3000))));
  return volume;
}

inline Mat3 turned() {
  return Eigen::AngleAxisd(0.3, Vec3(1, 2, -1).normalized()).toRotationMatrix();
}

}  // namespace osteon
