#pragma once

#include <epoxy/gl.h>
#include <gtest/gtest.h>

#include <optional>

#include "osteon/render/renderer.h"
#include "scenes.h"

namespace osteon {

/// An OpenGL context without a window; tests are skipped where there is none. Every test ends
/// without an OpenGL error.
class GlTest : public ::testing::Test {
 protected:
  void SetUp() override {
    auto made = OffscreenContext::create();
    if (!made) GTEST_SKIP() << "no OpenGL without a window here: " << made.error().message();
    context_.emplace(std::move(*made));
  }
  void TearDown() override {
    if (!context_) return;
    EXPECT_EQ(glGetError(), static_cast<GLenum>(GL_NO_ERROR));
    context_.reset();
  }

  static Renderer make_renderer(const Case& the_case, const Tool& tool = {}) {
    auto renderer = Renderer::create(the_case, tool, OSTEON_SOURCE_DIR);
    if (!renderer) throw std::runtime_error(renderer.error().message());
    return std::move(*renderer);
  }

  /// Looks along World's -z with y up from 0.3 m.
  static ViewState front_view(RenderQuality quality = RenderQuality::kFast) {
    ViewState view;
    view.camera.distance_m = 0.3;
    view.quality = quality;
    return view;
  }

 private:
  std::optional<OffscreenContext> context_;
};

inline std::array<int, 3> pixel(const Image& image, int x, int y) {
  const std::uint8_t* p =
      image.rgb.data() + 3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width) +
                              static_cast<std::size_t>(x));
  return {p[0], p[1], p[2]};
}

inline int brightness(const Image& image, int x, int y) {
  const auto [r, g, b] = pixel(image, x, y);
  return r + g + b;
}

/// Pixels whose channels differ by more than `threshold` together.
inline int count_different(const Image& a, const Image& b, int threshold) {
  int count = 0;
  for (std::size_t k = 0; k + 2 < a.rgb.size(); k += 3) {
    int sum = 0;
    for (std::size_t c = 0; c < 3; ++c) sum += std::abs(a.rgb[k + c] - b.rgb[k + c]);
    if (sum > threshold) ++count;
  }
  return count;
}

}  // namespace osteon
