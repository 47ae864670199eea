#pragma once

#include <vector>

#include "osteon/render/renderer.h"

namespace osteon {

/// What a scope's flat picture says of itself.
struct FlatReading {
  double gain = 0;       ///< of the camera; the picture's rim does not count
  double nearest_m = 0;  ///< the least distance of what it shows
};
/// Of the bound square picture of light and distance, `side` pixels wide, which it leaves in
/// `room`. Needs the context.
FlatReading read_flat(int side, std::vector<float>& room);

/// The bound picture, the upper row first. Needs the context.
Image read_back(int width, int height);

}  // namespace osteon
