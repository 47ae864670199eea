#include "segment/slice_texture.h"

#include <epoxy/gl.h>

namespace osteon {

SliceTexture::~SliceTexture() {
  if (name_ != 0) glDeleteTextures(1, &name_);
}

void SliceTexture::set(int width, int height, const std::vector<Rgba>& pixels) {
  if (name_ == 0) {
    glGenTextures(1, &name_);
    glBindTexture(GL_TEXTURE_2D, name_);
    // A texel is a pixel of the pane.
    for (const GLenum filter : {GL_TEXTURE_MIN_FILTER, GL_TEXTURE_MAG_FILTER})
      glTexParameteri(GL_TEXTURE_2D, filter, GL_NEAREST);
  }
  glBindTexture(GL_TEXTURE_2D, name_);
  glPixelStorei(GL_UNPACK_ALIGNMENT, 4);
  if (width != width_ || height != height_)
    glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, width, height, 0, GL_RGBA, GL_UNSIGNED_BYTE,
                 pixels.data());
  else
    glTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, width, height, GL_RGBA, GL_UNSIGNED_BYTE,
                    pixels.data());
  width_ = width;
  height_ = height;
  glBindTexture(GL_TEXTURE_2D, 0);
}

void* SliceTexture::handle() const {
  return reinterpret_cast<void*>(static_cast<std::uintptr_t>(name_));
}

}  // namespace osteon
