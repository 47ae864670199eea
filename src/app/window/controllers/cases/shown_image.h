#pragma once

#include "osteon/render/camera.h"
#include "osteon/render/renderer.h"

namespace osteon {

/// A picture on the graphics card. Needs the window's context in every call and in the destructor.
class ShownImage {
 public:
  ShownImage() = default;
  ~ShownImage();
  ShownImage(const ShownImage&) = delete;
  ShownImage& operator=(const ShownImage&) = delete;

  void set(const Image& image);
  void clear();
  /// Makes it this large, to be drawn into.
  void resize(int width, int height);
  bool empty() const { return texture_ == 0; }
  int width() const { return width_; }
  int height() const { return height_; }
  unsigned texture() const { return texture_; }
  unsigned framebuffer() const { return framebuffer_; }
  /// Copies it into the viewport of the framebuffer that is bound, as large as fits.
  void show(const Viewport& viewport) const;

 private:
  void make(int width, int height, const void* rgb);
  unsigned texture_ = 0, framebuffer_ = 0;
  int width_ = 0, height_ = 0;
  bool top_first_ = false;  ///< the texture's first row is the picture's top one
};

/// The largest part of a viewport, about its middle, that is as wide to its height.
Viewport fitted(const Viewport& viewport, int width, int height);

/// Fills a viewport of the framebuffer that is bound.
void fill_viewport(const Viewport& viewport, float r, float g, float b);

}  // namespace osteon
