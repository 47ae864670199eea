#pragma once

#include <filesystem>
#include <memory>
#include <span>

#include "osteon/base/result.h"
#include "osteon/render/prepare.h"
#include "osteon/render/renderer.h"
#include "osteon/render/scope_camera.h"
#include "osteon/scene/case.h"
#include "osteon/scene/state.h"
#include "osteon/scene/tool.h"

namespace osteon {

/// Draws what an arthroscope shows of a case, at rest until it is told otherwise, with OpenGL 3.3:
/// a round picture, lit from the tip, each tissue with the pattern of its kind, and the joint's
/// inner wall behind all. Needs a current context in every call and in the destructor, the same
/// one.
class ScopeRenderer {
 public:
  /// Fails when the shaders are missing or do not compile. `prepared` must come from
  /// prepare_case(the_case).
  static Result<ScopeRenderer> create(const Case& the_case, const std::filesystem::path& data_dir,
                                      const PreparedCase& prepared);
  ~ScopeRenderer();
  ScopeRenderer(ScopeRenderer&&) noexcept;
  ScopeRenderer& operator=(ScopeRenderer&&) noexcept;

  /// Shapes the joint's inner wall around a tip: within 60 mm of it, some 10 mm off the bones and
  /// farther where the tip is. Takes about a second. Fails when the tip lies in a bone, which it
  /// names, or at a place that is not finite.
  Result<void> set_room(const Vec3& tip_W);

  /// What hands may hold, by ToolState::instrument.
  void set_tray(std::span<const std::shared_ptr<const Tool>> tray);
  /// Bones stand so from now on, soft parts as the mean motion of theirs has it; these tools are
  /// seen, where their pose is finite. The wall stays as set_room shaped it.
  void set_scene(const BoneSnapshot& bones, std::span<const ToolState> tools);

  /// As Renderer has them.
  void set_cubes(BoneId bone, const CubeGrid& grid, std::span<const SurfaceCube> cubes);
  void clear_cubes();

  /// Sides are clamped to 1..kMaxImageSide. Without a room the wall is missing. Empty when the
  /// driver has no memory for it.
  Image draw_image(const ScopeCamera& camera, int width, int height,
                   RenderQuality quality = RenderQuality::kFine);

 private:
  struct Impl;
  explicit ScopeRenderer(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace osteon
