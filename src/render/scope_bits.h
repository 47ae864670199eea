#pragma once

#include <filesystem>
#include <span>
#include <vector>

#include "gl/gl_objects.h"
#include "osteon/base/result.h"
#include "osteon/render/water_bit.h"

namespace osteon {

/// Bubbles and loose tissue in a scope's flat picture: squares, whose program cuts the shapes out
/// of them. Costs nothing where there are none.
class ScopeBits {
 public:
  static Result<ScopeBits> load(const std::filesystem::path& shaders);

  /// Compiles its program, if no picture has asked for it yet; false: it is there.
  bool ready_one() const;
  /// What is out of range or not finite is left out.
  void set(std::span<const WaterBit> bits);
  const std::vector<WaterBit>& bits() const { return bits_; }
  /// Into the bound framebuffer, behind and before what its depth tells. Flakes leave their
  /// distance there; bubbles, which are seen through, do not.
  void paint(const Pose& X_CW, const Eigen::Matrix4f& clip_from_view) const;

 private:
  void paint_some(WaterBit::Is is, const Pose& X_CW) const;

  LateProgram program_;
  GlVertexArray array_;
  GlBuffer vertices_;
  std::vector<WaterBit> bits_;
};

}  // namespace osteon
