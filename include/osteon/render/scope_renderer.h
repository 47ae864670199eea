#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>

#include "osteon/base/result.h"
#include "osteon/mesh/tri_mesh.h"
#include "osteon/render/prepare.h"
#include "osteon/render/renderer.h"
#include "osteon/render/scope_camera.h"
#include "osteon/render/water_bit.h"
#include "osteon/render/white_balance.h"
#include "osteon/scene/case.h"
#include "osteon/scene/state.h"
#include "osteon/scene/tool.h"

namespace osteon {

/// Blood before a wound that bleeds: thickest in its middle, to exp(-1/2) at its radius.
struct BloodPlume {
  Vec3 p_W = Vec3::Zero();
  double radius_m = 0;
  double taken_per_m = 0;  ///< light that it takes in its middle, each metre
  bool operator==(const BloodPlume&) const = default;
};

/// What stands between a scope and what it looks at.
struct ScopeWater {
  static constexpr std::size_t kMostPlumes = 6;
  double taken_per_m = 0;  ///< light that the water takes, each metre
  double blood = 0;        ///< share of that which blood takes, 0 to 1; the rest is pale debris
  double fog = 0;          ///< share of the lens that is fogged, 0 to 1
  std::uint32_t plume_count = 0;
  std::array<BloodPlume, kMostPlumes> plumes{};
  bool clear() const { return !(taken_per_m > 0) && plume_count == 0; }
  bool operator==(const ScopeWater&) const = default;
};

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
  /// Draws the surfaces and the tray that `scene` has on the graphics card, also those that it is
  /// given later. `scene` was made of the same case.
  static Result<ScopeRenderer> create(const Case& the_case, const std::filesystem::path& data_dir,
                                      const Renderer& scene);
  ~ScopeRenderer();
  ScopeRenderer(ScopeRenderer&&) noexcept;
  ScopeRenderer& operator=(ScopeRenderer&&) noexcept;

  /// The joint's inner wall, in World, from now on; see JointRoom. Without one it is missing.
  void set_wall(const TriMesh& wall_W);

  /// What hands may hold, by ToolState::instrument; where a scene is drawn, that one's tray counts.
  void set_tray(std::span<const std::shared_ptr<const Tool>> tray);
  /// Bones stand so from now on, soft parts as the mean motion of theirs has it; these tools are
  /// seen, where their pose is finite. The wall stays as it is.
  void set_scene(const BoneSnapshot& bones, std::span<const ToolState> tools);

  /// Instruments that are only shown, from now on, seen through; those given before are gone.
  void set_ghosts(std::span<const GhostTool> ghosts);

  /// Clear until it is told otherwise.
  void set_water(const ScopeWater& water);

  /// Bubbles and loose tissue in the water, from now on; those given before are gone. At most
  /// kMostWaterBits are seen.
  void set_water_bits(std::span<const WaterBit> bits);

  /// Balanced to its own light until it is told otherwise.
  void set_white_balance(const WhiteBalance& white);

  /// As Renderer has it, of a bone or a soft part; where a scene is drawn, its surfaces are seen.
  void set_surface(BoneId part, const TriMesh& mesh);
  /// As Renderer has it; where a scene is drawn, its surfaces are seen.
  void move_surface(BoneId part, const TriMesh& rest_W, const TriMesh& moved_W,
                    std::span<const float> depth_m = {});
  /// As Renderer has them.
  void set_cubes(BoneId bone, const CubeGrid& grid, std::span<const SurfaceCube> cubes);
  /// As of Renderer; does nothing where the surfaces are a renderer's.
  void set_loose(std::uint64_t shape, BoneId bone, const SurfaceCube& surface);
  void clear_cubes();

  /// Sides are clamped to 1..kMaxImageSide. Empty when the driver has no memory for it.
  Image draw_image(const ScopeCamera& camera, int width, int height,
                   RenderQuality quality = RenderQuality::kFine);

  /// Draws a square picture with so many pixels a side, which `show` then copies: for a window.
  /// What has not moved is not drawn anew. The camera's gain follows what it saw a picture before.
  /// False when the driver has no memory for it.
  bool paint(const ScopeCamera& camera, int side_px);
  /// Copies the picture of the last `paint` into the viewport of the framebuffer that is bound,
  /// scaled to it. Leaves that framebuffer bound.
  void show(const Viewport& viewport) const;

 private:
  struct Impl;
  explicit ScopeRenderer(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace osteon
