#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "osteon/base/result.h"
#include "osteon/base/types.h"
#include "osteon/render/anatomical_view.h"
#include "osteon/render/camera.h"
#include "osteon/render/prepare.h"
#include "osteon/scene/case.h"
#include "osteon/scene/state.h"
#include "osteon/scene/tool.h"

namespace osteon {

struct BoneAppearance {
  std::array<float, 3> color{0.89f, 0.84f, 0.73f};  ///< sRGB, 0..1
  float opacity = 1;
  bool visible = true;
  bool highlighted = false;  ///< an accent outline; its own colour stays
  bool operator==(const BoneAppearance&) const = default;
};

enum class RenderQuality {
  kFast,  ///< for a window: smooth edges as far as this OpenGL driver gives them cheaply
  kFine   ///< for a still: supersampled
};

/// How to draw; all that a user may change without touching the simulation.
struct ViewState {
  Camera camera;
  std::vector<BoneAppearance> bones;  ///< one a bone; bones past its end look as the default
  /// One a soft part; those past its end are not drawn.
  std::vector<BoneAppearance> softs;
  bool show_hulls = false;
  /// Bones by the height of what is felt over them (felt_colors.h), where prepare_felt told it.
  bool show_felt = false;
  /// Bones by the hottest temperature that they had (heat_colors.h), where set_heat told it.
  bool show_heat = false;
  bool show_proxy = true;
  bool show_force = true;
  bool show_loose = true;           ///< pieces of bone that were cut off
  bool show_hand_ghost = true;      ///< the hand's own pose when it differs from the proxy's
  double light_azimuth_rad = -0.7;  ///< of the key light, relative to the camera; negative: left
  double light_elevation_rad = 0.8;
  float light_brightness = 1;
  float ambient_occlusion = 1;  ///< 0 switches it off
  RenderQuality quality = RenderQuality::kFast;
  bool operator==(const ViewState&) const = default;
};
/// Dorsal view, every bone in its own slight tone of ivory, soft parts in the colours of their
/// tissues but hidden: nothing of them is felt. The skin, once shown, is see-through.
ViewState default_view(const Case& the_case);

/// The force arrow is this long for each newton.
inline constexpr double kForceArrowMetresPerNewton = 0.010;

/// Pixels, 8-bit RGB, top row first.
struct Image {
  int width = 0, height = 0;
  std::vector<std::uint8_t> rgb;
};
/// Writes a PNG in one step, see write_file_atomic. Fails on an empty image.
Result<void> save_png(const Image& image, const std::filesystem::path& file);

/// The largest width or height of draw_image, pixels.
inline constexpr int kMaxImageSide = 8192;

/// A point of a bone's surface.
struct SurfacePoint {
  BoneId bone;  ///< none: the ground
  Vec3 p_W = Vec3::Zero();
};

/// A surface that is drawn over a scene, seen through: a cone of sight, a planned line.
struct SolidMark {
  TriMesh mesh_W;                                             ///< closed, facing outwards
  std::array<float, 4> color_srgba{1.0f, 0.85f, 0.2f, 0.3f};  ///< 0..1
};

/// An instrument that is only shown: seen through, without a shade, touching nothing. An expert's,
/// beside the user's own. Where ViewState::show_proxy is off it is not drawn either.
struct GhostTool {
  Pose X_WT;
  std::uint32_t instrument = 0;  ///< as ToolState has it
  float opacity = 0.5f;          ///< 0..1; below 0.02, or not a number: not drawn
};

/// Cubes of a grid over a bone, x fastest, in Bone; of a soft part in a frame of its own.
struct CubeGrid {
  Vec3 lo_B = Vec3::Zero();
  double side_m = 0;
  std::array<int, 3> count{};
  /// Inside of the changed cubes the bone's own surface is left for so far from cubes beside them
  /// that have not changed: at least by what a new surface may fall short of its cube.
  double overlap_m = 0;
  Pose X_GM = {};  ///< of the grid's frame in that of the surface
};
/// What of a bone's surface lies in one cube now.
struct SurfaceCube {
  std::uint32_t cube = 0;
  std::vector<Vec3> vertices, normals;  ///< in the surface's frame: Bone, or World at rest
  std::vector<float> depth_m;           ///< of each vertex, under the surface as it was
  std::vector<Triangle> triangles;      ///< none: nothing is left there
};

/// How warm a bone became, on cells of a box, x fastest.
struct HeatCells {
  static constexpr double kFrom_c = 37, kTo_c = 69;  ///< that bytes 0 and 255 stand for
  Vec3 lo_B = Vec3::Zero();                          ///< middle of the first cell
  double cell_m = 0;
  std::array<int, 3> count{};
  std::vector<std::array<std::uint8_t, 2>> cells;  ///< the hottest so far; 255 where it is dead
};

/// Draws a snapshot with OpenGL 3.3. Needs a current context in every call and in the destructor,
/// the same one. Keeps copies of what it needs of the case and the tool. A bone or tool whose pose
/// is not finite is not drawn.
class Renderer {
 public:
  /// Fails when the shaders in `data_dir`/shaders are missing or do not compile, or when the
  /// context is older than OpenGL 3.3. `prepared` must come from prepare_case(the_case).
  static Result<Renderer> create(const Case& the_case, const Tool& tool,
                                 const std::filesystem::path& data_dir,
                                 const PreparedCase& prepared);
  /// Prepares the case itself: blocks for about a second on a real wrist.
  static Result<Renderer> create(const Case& the_case, const Tool& tool,
                                 const std::filesystem::path& data_dir);
  ~Renderer();
  Renderer(Renderer&&) noexcept;
  Renderer& operator=(Renderer&&) noexcept;

  /// Draws the same scene for another place on the screen: surfaces and tray are on the graphics
  /// card once, and what is set of them holds for both; the tools of other hands, marks and the
  /// pictures kept are each one's own.
  Renderer another_view() const;

  /// Takes surfaces of the same case that tell more than those before, as prepare_felt makes them.
  void set_surfaces(const PreparedCase& prepared);
  /// Draws the pieces of this case as what is felt (ViewState::show_hulls) from now on: the same
  /// bones, felt otherwise.
  void set_pieces(const Case& the_case);
  /// What hands may hold, by ToolState::instrument; what is not in it is drawn as the first. Until
  /// then all hold the tool that the renderer was made with.
  void set_tray(std::span<const std::shared_ptr<const Tool>> tray);
  /// Tools of the other hands from now on, drawn beside the snapshot's own; without marks.
  void set_others(std::span<const ToolState> others);
  /// Instruments that are only shown, from now on; those given before are gone.
  void set_ghosts(std::span<const GhostTool> ghosts);
  /// Where a processor draws: this share of width and height is drawn of a picture in which all
  /// moves, and spread over the viewport; it is whole and sharp again a few pictures after all came
  /// to rest. 1, as it is at first: always whole. Clamped to 0.25..1.
  void set_moving_detail(double share);
  /// The last draw kept nothing of the picture before, so its time is that of a whole picture.
  bool drew_all() const;
  /// Drawn from now on, after the bones; those given before are gone.
  void set_marks(std::span<const SolidMark> marks);
  /// The same for marks that move with instruments, and are drawn where those are
  /// (ViewState::show_proxy): other ones in each picture cost little.
  void set_moving_marks(std::span<const SolidMark> marks);

  /// Draws into the viewport of the framebuffer that is bound; touches nothing outside it. Leaves
  /// that framebuffer bound, depth test, blending, culling and scissor off. Where a processor
  /// draws, what stands still from one call to the next is kept, and only the parts that the tool
  /// changes are drawn anew.
  void draw(const RenderSnapshot& snapshot, const ViewState& view, const Viewport& viewport);
  /// Draws off-screen and reads the pixels back. Sides are clamped to 1..kMaxImageSide. Empty when
  /// the driver has no memory for it.
  Image draw_image(const RenderSnapshot& snapshot, const ViewState& view, int width, int height);
  /// The same for a picture that follows another of its size, as a film's do: of what stands still
  /// from one call to the next nothing is drawn anew (see `draw`). The same pixels as `draw` has.
  Image draw_next_image(const RenderSnapshot& snapshot, const ViewState& view, int width,
                        int height);
  /// Bone under a pixel of the viewport (origin top left), none over the ground. Only visible
  /// bones; the force arrow and the probe are looked through. Needs no OpenGL.
  BoneId pick(const RenderSnapshot& snapshot, const ViewState& view, const Viewport& viewport,
              double x_px, double y_px) const;

  /// The same, with the point that is seen there.
  SurfacePoint pick_point(const RenderSnapshot& snapshot, const ViewState& view,
                          const Viewport& viewport, double x_px, double y_px) const;

  /// Shows and picks another surface for a bone from now on, in Bone: of one that is being edited.
  /// It is drawn without the light worked out beforehand between the bones.
  void set_surface(BoneId bone, const TriMesh& mesh_B);

  /// A soft part has given way: it is drawn so from now on, and keeps at each vertex the light that
  /// was worked out for it at rest. `part`: its place behind the bones; both meshes in World with
  /// the bones at rest, `rest_W` the one of the case. See set_soft_surface.
  /// `depth_m`: of one that was cut open, of each vertex how deep it lies in a cut; its first
  /// vertices are those of `rest_W`. None: it has the vertices of `rest_W` alone.
  void move_surface(BoneId part, const TriMesh& rest_W, const TriMesh& moved_W,
                    std::span<const float> depth_m = {});

  /// From now on these cubes of the grid show this of a bone, in place of its own surface: of one
  /// that is being carved, and are picked so. Those given before stay. The bone's outline stays as
  /// it was. Of a soft part the same: its place behind the bones, as move_surface has it. Does
  /// nothing where the grid has no cubes or more than 16 million.
  void set_cubes(BoneId bone, const CubeGrid& grid, std::span<const SurfaceCube> cubes);
  /// A piece of a bone that was cut off, in Bone before it fell: drawn where a snapshot has a loose
  /// bone of that shape.
  void set_loose(std::uint64_t shape, BoneId bone, const SurfaceCube& surface);
  /// Every bone shows its own surface again, and was never warm.
  void clear_cubes();
  /// How warm a bone became, for ViewState::show_heat; with no cells it was never warm.
  void set_heat(BoneId bone, const HeatCells& heat);

  /// "llvmpipe (LLVM 15.0.6, 256 bits)": OpenGL's own name of what draws.
  std::string device_name() const;
  /// True when a processor draws, not a graphics card.
  bool software_driver() const;

 private:
  friend class ScopeRenderer;  // draws the same surfaces
  struct Impl;
  explicit Renderer(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

/// OpenGL without a window (EGL, surfaceless; Mesa's software driver will do). Current on the
/// thread that made it until destroyed.
class OffscreenContext {
 public:
  static Result<OffscreenContext> create();
  ~OffscreenContext();
  OffscreenContext(OffscreenContext&&) noexcept;
  OffscreenContext& operator=(OffscreenContext&&) noexcept;

 private:
  struct Impl;
  explicit OffscreenContext(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace osteon
