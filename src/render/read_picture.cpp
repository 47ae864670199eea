#include "read_picture.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <limits>
#include <vector>

#include "view/exposure.h"

namespace osteon {
namespace {

/// Some 45 rows and columns of the middle tell it.
double gain_of(const std::vector<float>& all, std::size_t width) {
  const std::size_t step = std::max<std::size_t>(1, width / 64), from = width / 6;
  std::vector<double> light;
  for (std::size_t y = from; y < width - from; y += step) {
    for (std::size_t x = from; x < width - from; x += step) {
      const float* at = all.data() + 4 * (y * width + x);
      light.push_back(0.3 * static_cast<double>(at[0]) + 0.6 * static_cast<double>(at[1]) +
                      0.1 * static_cast<double>(at[2]));
    }
  }
  return exposure_gain(light);
}

/// Every other pixel and row: what is near is not small.
double nearest_of(const std::vector<float>& all, std::size_t width) {
  float nearest_m = std::numeric_limits<float>::infinity();
  for (std::size_t y = 0; y < width; y += 2)
    for (std::size_t x = 0; x < width; x += 2)
      nearest_m = std::min(nearest_m, all[4 * (y * width + x) + 3]);
  return static_cast<double>(nearest_m);
}

}  // namespace

// All at once: a driver takes longer to begin a reading than to read what is left out below.
FlatReading read_flat(int side, std::vector<float>& room) {
  const std::size_t width = static_cast<std::size_t>(std::max(side, 0));
  room.resize(4 * width * width);
  glReadPixels(0, 0, side, side, GL_RGBA, GL_FLOAT, room.data());
  FlatReading out;
  out.gain = gain_of(room, width);
  out.nearest_m = nearest_of(room, width);
  return out;
}

Image read_back(int width, int height) {
  Image image{width, height, {}};
  const std::size_t row_bytes = 3u * static_cast<std::size_t>(width);
  image.rgb.resize(row_bytes * static_cast<std::size_t>(height));
  std::vector<std::uint8_t> up(image.rgb.size());
  glPixelStorei(GL_PACK_ALIGNMENT, 1);
  glReadPixels(0, 0, width, height, GL_RGB, GL_UNSIGNED_BYTE, up.data());
  for (int row = 0; row < height; ++row)
    std::memcpy(image.rgb.data() + static_cast<std::size_t>(height - 1 - row) * row_bytes,
                up.data() + static_cast<std::size_t>(row) * row_bytes, row_bytes);
  return image;
}

}  // namespace osteon
