#include "window/controllers/cases/shown_image.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <cmath>

namespace osteon {

Viewport fitted(const Viewport& viewport, int width, int height) {
  if (viewport.empty() || width <= 0 || height <= 0) return {};
  const double scale = std::min(static_cast<double>(viewport.width) / width,
                                static_cast<double>(viewport.height) / height);
  Viewport part;
  part.width = std::clamp(static_cast<int>(std::lround(scale * width)), 1, viewport.width);
  part.height = std::clamp(static_cast<int>(std::lround(scale * height)), 1, viewport.height);
  part.x = viewport.x + (viewport.width - part.width) / 2;
  part.y = viewport.y + (viewport.height - part.height) / 2;
  return part;
}

void fill_viewport(const Viewport& viewport, float r, float g, float b) {
  if (viewport.empty()) return;
  glEnable(GL_SCISSOR_TEST);
  glScissor(viewport.x, viewport.y, viewport.width, viewport.height);
  glClearColor(r, g, b, 1);
  glClear(GL_COLOR_BUFFER_BIT);
  glDisable(GL_SCISSOR_TEST);
}

ShownImage::~ShownImage() { clear(); }

void ShownImage::clear() {
  if (framebuffer_ != 0) glDeleteFramebuffers(1, &framebuffer_);
  if (texture_ != 0) glDeleteTextures(1, &texture_);
  framebuffer_ = texture_ = 0;
}

void ShownImage::set(const Image& image) {
  if (!image.rgb.empty()) make(image.width, image.height, image.rgb.data());
}

void ShownImage::resize(int width, int height) {
  if (texture_ == 0 || width != width_ || height != height_) make(width, height, nullptr);
}

void ShownImage::make(int width, int height, const void* rgb) {
  GLint bound = 0;
  glGetIntegerv(GL_FRAMEBUFFER_BINDING, &bound);
  if (texture_ == 0) glGenTextures(1, &texture_);
  if (framebuffer_ == 0) glGenFramebuffers(1, &framebuffer_);
  width_ = width;
  height_ = height;
  top_first_ = rgb != nullptr;
  glBindTexture(GL_TEXTURE_2D, texture_);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
  glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, width, height, 0, GL_RGB, GL_UNSIGNED_BYTE, rgb);
  glPixelStorei(GL_UNPACK_ALIGNMENT, 4);
  glBindTexture(GL_TEXTURE_2D, 0);
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_);
  glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, texture_, 0);
  glBindFramebuffer(GL_FRAMEBUFFER, static_cast<GLuint>(bound));
}

void ShownImage::show(const Viewport& viewport) const {
  const Viewport at = fitted(viewport, width_, height_);
  if (empty() || at.empty()) return;
  GLint bound = 0;
  glGetIntegerv(GL_DRAW_FRAMEBUFFER_BINDING, &bound);
  glBindFramebuffer(GL_READ_FRAMEBUFFER, framebuffer_);
  glBlitFramebuffer(0, top_first_ ? height_ : 0, width_, top_first_ ? 0 : height_, at.x, at.y,
                    at.x + at.width, at.y + at.height, GL_COLOR_BUFFER_BIT, GL_LINEAR);
  glBindFramebuffer(GL_FRAMEBUFFER, static_cast<GLuint>(bound));
}

}  // namespace osteon
