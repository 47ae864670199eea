#include "read_picture.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <vector>

#include "view/exposure.h"

namespace osteon {

double gain_for(int side) {
  const int step = std::max(1, side / 64), from = side / 6, to = side - side / 6;
  const int width = std::max(to - from, 0);
  std::vector<float> row(4u * static_cast<std::size_t>(width));
  std::vector<double> light;
  for (int y = from; y < to; y += step) {
    glReadPixels(from, y, width, 1, GL_RGBA, GL_FLOAT, row.data());
    for (int x = 0; x < width; x += step) {
      const float* at = row.data() + 4u * static_cast<std::size_t>(x);
      light.push_back(0.3 * static_cast<double>(at[0]) + 0.6 * static_cast<double>(at[1]) +
                      0.1 * static_cast<double>(at[2]));
    }
  }
  return exposure_gain(light);
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
