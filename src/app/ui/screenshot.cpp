#include "ui/screenshot.h"

#include <epoxy/gl.h>

#include <algorithm>

namespace osteon {

Image read_framebuffer(int width, int height) {
  Image image{width, height, {}};
  const std::size_t row = 3 * static_cast<std::size_t>(width);
  image.rgb.resize(row * static_cast<std::size_t>(height));
  glBindFramebuffer(GL_FRAMEBUFFER, 0);
  glReadBuffer(GL_BACK);
  glPixelStorei(GL_PACK_ALIGNMENT, 1);
  glReadPixels(0, 0, width, height, GL_RGB, GL_UNSIGNED_BYTE, image.rgb.data());
  // OpenGL counts rows from below.
  for (std::size_t y = 0; y < static_cast<std::size_t>(height) / 2; ++y)
    std::swap_ranges(image.rgb.begin() + static_cast<std::ptrdiff_t>(y * row),
                     image.rgb.begin() + static_cast<std::ptrdiff_t>((y + 1) * row),
                     image.rgb.end() - static_cast<std::ptrdiff_t>((y + 1) * row));
  return image;
}

}  // namespace osteon
