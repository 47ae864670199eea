#pragma once

#include <cstdint>
#include <vector>

#include "segment/slice_picture.h"

namespace osteon {

/// A pane's picture on the graphics card. Needs a current context in every call.
class SliceTexture {
 public:
  SliceTexture() = default;
  ~SliceTexture();
  SliceTexture(const SliceTexture&) = delete;
  SliceTexture& operator=(const SliceTexture&) = delete;

  void set(int width, int height, const std::vector<Rgba>& pixels);
  /// As ImGui takes it; null before the first `set`.
  void* handle() const;

 private:
  std::uint32_t name_ = 0;
  int width_ = 0, height_ = 0;
};

}  // namespace osteon
