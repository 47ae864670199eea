#pragma once

#include "gl/gl_objects.h"

namespace osteon {

/// A square of linear light in floats, with its distance from the eye, to be read in a shader.
class LightTarget {
 public:
  /// Makes it this size unless it is already. False when the driver refuses.
  bool ensure(int side);
  GLuint framebuffer() const { return framebuffer_.get(); }
  GLuint texture() const { return texture_.get(); }
  int side() const { return side_; }

 private:
  int side_ = 0;
  GlFramebuffer framebuffer_;
  GlTexture texture_;
  GlRenderbuffer depth_;
};

}  // namespace osteon
