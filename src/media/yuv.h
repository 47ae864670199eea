#pragma once

#include <cstdint>
#include <span>

namespace osteon {

/// A plane of one byte a sample, rows from the top.
struct BytePlane {
  std::uint8_t* bytes = nullptr;
  int stride = 0;
};

/// 8-bit RGB to luma and two planes of colour at half the size (rounded up), BT.709, 16 to 235 and
/// 16 to 240 (ITU-R BT.709-6, 3.4 and 3.5). A colour sample is the mean of the pixels that it
/// covers. Whole numbers throughout.
void to_yuv420(std::span<const std::uint8_t> rgb, int width, int height, BytePlane y, BytePlane cb,
               BytePlane cr);

}  // namespace osteon
