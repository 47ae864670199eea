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
  double nearest_m = 0;       ///< nothing in it is nearer
  double exposure = 1;        ///< the camera's gain
  Vec3 white = Vec3::Ones();  ///< shown of a white surface, linear
  Viewport viewport;
};

/// A scope's optics: barrel distortion, focus, water and fog over the flat picture.
class ScopeLens {
 public:
  static Result<ScopeLens> load(const std::filesystem::path& shaders);
  /// Whether anything at that distance or beyond is out of focus in a flat picture of so many
  /// pixels.
  static bool is_soft(double nearest_m, int side_px);
  /// Compiles one of the programs that no picture has asked for yet, and draws nothing with it: a
  /// driver does half of the work at the first drawing. False: there is none.
  bool ready_one(const LightTarget& flat, const RenderTarget& picture);
  /// Binds `picture`'s framebuffer and draws into it. What a picture needs is compiled for the
  /// first that needs it; what does not compile is left out.
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
  /// Draws into none of the pixels, with what a picture has bound.
  void draw_nothing(const Program& program, GLuint from, GLuint framebuffer) const;
  static void soften(const Program& softer, GLuint from, const Soft& to, double spread);
  /// How much light the water takes on the way, over the flat picture.
  void measure_water(const LightTarget& flat, const LensView& view, const ScopeWater& water) const;

  std::array<LateProgram, 3> softer_;  ///< to half_, to quarter_, and to milky_
  Soft half_, quarter_;                ///< as wide as their names say
  LateProgram water_;
  Soft on_the_way_;  ///< half as wide: thickness of the water, and plumes
  Soft milky_;       ///< an eighth as wide: light that fog spreads
  Program clear_;
  std::array<LateProgram, 8> lenses_;  ///< kSeesWater, kSeesFog and kSeesSoft, added
  GlVertexArray no_vertices_;
  GlTexture clouds_;  ///< of water
};

}  // namespace osteon
