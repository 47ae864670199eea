#pragma once

#include "gl/gl_objects.h"

namespace osteon {

/// Colour (RGBA, 8 bits) and depth to draw into. `samples` 0 gives a texture that can be read in a
/// shader.
class RenderTarget {
 public:
  RenderTarget() = default;
  /// Makes it this size and kind unless it is already. False when the driver refuses.
  bool ensure(int width, int height, int samples);

  GLuint framebuffer() const { return framebuffer_.get(); }
  GLuint texture() const { return texture_.get(); }
  int width() const { return width_; }
  int height() const { return height_; }

 private:
  void attach_color();
  int width_ = 0, height_ = 0, samples_ = 0;
  GlFramebuffer framebuffer_;
  GlTexture texture_;
  GlRenderbuffer color_, depth_;
};

}  // namespace osteon
