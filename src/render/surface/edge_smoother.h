#pragma once

#include <span>

#include "gl/gl_objects.h"
#include "gl/render_target.h"
#include "osteon/render/camera.h"

namespace osteon {

/// Smooths the edges of a finished picture, for drivers where more samples a pixel cost too much
/// (after Lottes' FXAA, 2009).
class EdgeSmoother {
 public:
  static Result<EdgeSmoother> create(const std::filesystem::path& shader_dir);

  /// Smooths the edges within the areas. `target` holds the picture of `source`, of the same size,
  /// in them already, and keeps what is outside them.
  void smooth(const RenderTarget& source, const RenderTarget& target,
              std::span<const Viewport> areas) const;

 private:
  Program find_, blur_;
  GlVertexArray no_vertices_;
};

}  // namespace osteon
