#pragma once

#include <array>
#include <filesystem>

#include "gl/gl_objects.h"
#include "gl/light_target.h"
#include "gl/render_target.h"
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
  /// Binds `picture`'s framebuffer and draws into it.
  void paint(const LightTarget& flat, const RenderTarget& picture, const LensView& view,
             const ScopeWater& water);

 private:
  /// The flat picture out of focus, on a coarser grid.
  struct Soft {
    bool ensure(int side);
    int side = 0;
    GlFramebuffer framebuffer;
    GlTexture texture;
  };
  static void soften(const Program& softer, GLuint from, const Soft& to, double spread);
  void set_water(const Program& lens, const ScopeWater& water) const;

  std::array<Program, 2> softer_;  ///< to half_, and to quarter_
  Soft half_, quarter_;            ///< as wide as their names say
  std::array<Program, 4> lenses_;  ///< kSeesWater and kSeesFog, added
  GlVertexArray no_vertices_;
  GlTexture clouds_;  ///< of water
};

}  // namespace osteon
