#pragma once

#include <array>
#include <filesystem>

#include "gl/gl_objects.h"
#include "gl/light_target.h"
#include "osteon/base/result.h"
#include "osteon/render/scope_camera.h"
#include "osteon/render/scope_renderer.h"

namespace osteon {

/// How a flat picture is seen through the lens.
struct LensView {
  const ScopeCamera& camera;
  double half = 1;            ///< tangent of half the flat picture's width
  double exposure = 1;        ///< the camera's gain
  Vec3 white = Vec3::Ones();  ///< shown of a white surface, linear
  Viewport viewport;
};

/// A scope's optics: barrel distortion, focus, water and fog over the flat picture.
class ScopeLens {
 public:
  static Result<ScopeLens> load(const std::filesystem::path& shaders);
  /// Into the bound framebuffer.
  void paint(const LightTarget& flat, const LensView& view, const ScopeWater& water) const;

 private:
  void set_water(const Program& lens, const ScopeWater& water) const;

  std::array<Program, 4> lenses_;  ///< kSeesWater and kSeesFog, added
  GlVertexArray no_vertices_;
  GlTexture clouds_;  ///< of water
};

}  // namespace osteon
