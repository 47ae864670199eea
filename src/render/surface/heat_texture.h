#pragma once

#include "gl/gl_objects.h"
#include "osteon/render/renderer.h"

namespace osteon {

/// How warm a bone became, for the shader that colours it so.
class HeatTexture {
 public:
  /// See Renderer::set_heat.
  void set(const HeatCells& heat);
  bool empty() const { return count_[0] == 0; }
  /// Tells a program whose shader knows of it (in use).
  void show(const Program& program) const;
  /// The colours, the same for all bones.
  static void set_colors(const Program& program);

 private:
  GlTexture cells_;
  Vec3 lo_B_ = Vec3::Zero();
  double cell_m_ = 0;
  std::array<int, 3> count_{};
};

}  // namespace osteon
