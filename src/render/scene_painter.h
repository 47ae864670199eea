#pragma once

#include <array>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "gl/frame.h"
#include "gl/gl_objects.h"
#include "gl/gpu_mesh.h"
#include "gl/tile_mask.h"
#include "osteon/render/renderer.h"
#include "osteon/scene/bench_rods.h"
#include "osteon/scene/limb_cover.h"
#include "surface/changed_cubes.h"
#include "surface/heat_texture.h"
#include "surface/moved_light.h"
#include "surface/surface_changes.h"

namespace osteon {

/// Programs and meshes of a case and its tool, and the order in which they are drawn. Several
/// painters may share them, each with other tools and marks of its own.
class ScenePainter {
 public:
  static Result<ScenePainter> create(const Case& the_case, const Tool& tool,
                                     const std::filesystem::path& shader_dir,
                                     const PreparedCase& prepared);
  /// Shares all that is set of surfaces and tray, now and later.
  ScenePainter another() const;
  /// Grows whenever what is shared changes.
  std::uint64_t version() const { return shared_->changes.version(); }
  /// False: since then more has changed than changed_tiles() knows of.
  bool knows_changes_since(std::uint64_t version) const {
    return shared_->changes.known_since(version);
  }
  /// The finest surface of a model: the bones, after them the soft parts.
  const GpuMesh& exact_surface(std::size_t k) const;
  /// The coarsest that lies within `error_m` of it.
  const GpuMesh& surface_within(std::size_t k, double error_m) const;
  /// Where something else stands than that surface, of a bone.
  const ChangedCubes& changed(std::size_t bone) const { return shared_->bones[bone].changed; }
  /// By ToolState::instrument and jaw_step(); null: the tray has no such place.
  const GpuMesh* tool_surface(std::uint32_t instrument, std::size_t jaw) const {
    return instrument < shared_->tools.size() ? &model_at(instrument, jaw).mesh : nullptr;
  }

  /// Draws the bones with these surfaces from now on; of the case that it was made with.
  void set_surfaces(const PreparedCase& prepared);
  void set_pieces(const Case& the_case);
  /// The model's surface has given way to another: it keeps the light of each vertex. `rest_W` is
  /// what the surfaces were prepared of.
  void move_surface(std::size_t k, const TriMesh& rest_W, const TriMesh& moved_W,
                    std::span<const float> depth_m);
  /// Another surface for a model from now on, without its coarser levels and its baked light.
  void set_surface(std::size_t k, const TriMesh& mesh_B);
  void set_cubes(std::size_t bone, const CubeGrid& grid, std::span<const SurfaceCube> cubes);
  void clear_cubes();
  /// The surface of a piece of that bone that was cut off, in Bone; drawn where a snapshot has it.
  void set_loose(std::uint64_t shape, std::size_t bone, const SurfaceCube& surface);
  /// Null: it is not known.
  const GpuMesh* loose_surface(std::uint64_t shape) const;
  void set_heat(std::size_t bone, const HeatCells& heat);
  /// What hands may hold, by ToolState::instrument; not empty.
  void set_tray(std::span<const std::shared_ptr<const Tool>> tray);
  /// Tools of the other hands.
  void set_others(std::span<const ToolState> others) {
    others_.assign(others.begin(), others.end());
  }
  std::span<const ToolState> others() const { return others_; }
  /// Of those given only those that can be seen are kept.
  void set_ghosts(std::span<const GhostTool> ghosts);
  std::span<const GhostTool> ghosts() const { return ghosts_; }
  void set_marks(std::span<const SolidMark> marks);
  void set_moving_marks(std::span<const SolidMark> marks);
  /// Box around everything that the snapshot shows.
  Aabb content(const RenderSnapshot& snapshot, const ViewState& view) const;
  /// Fills the bound framebuffer's current viewport with what is behind everything.
  void paint_ground(const PictureWindow& window) const;
  /// Draws over the ground into the bound framebuffer's current viewport; its depth is cleared.
  void paint(const RenderSnapshot& snapshot, const ViewState& view, const Frame& frame) const;

  /// Tiles where the tool, the hand's ghost, the marks or their shade can be seen; `width` and
  /// `height` are the frame's output pixels.
  TileMask moving_tiles(const RenderSnapshot& snapshot, const ViewState& view, const Frame& frame,
                        int width, int height) const;
  /// Tiles where surfaces have changed since then.
  TileMask changed_tiles(std::uint64_t since, const RenderSnapshot& snapshot, const ViewState& view,
                         const Frame& frame, int width, int height) const;
  /// True when no bone has moved by more than a twentieth of a pixel.
  bool bones_look_still(const BoneSnapshot& before, const BoneSnapshot& now,
                        const Frame& frame) const;

 private:
  /// All points within the radius of a segment.
  struct Capsule {
    Vec3 a = Vec3::Zero(), b = Vec3::Zero();
    double radius_m = 0;
  };
  struct ToolModel {
    GpuMesh mesh;
    std::vector<ToolModel> opened;  ///< as of Tool
    std::vector<Capsule> capsules;
    double length_m = 0, tip_radius_m = 0;
    Vec3 shaft_T = Vec3::Zero();  ///< the shaft runs along z through here, in Tool
  };
  static ToolModel make_tool_model(const Tool& tool);
  static ToolModel make_tool_model(const TriMesh& mesh, double tip_radius_m);
  const ToolModel& model_at(std::uint32_t instrument, std::size_t jaw = 0) const {
    const std::vector<ToolModel>& tools = shared_->tools;
    const ToolModel& shut = tools[instrument < tools.size() ? instrument : 0];
    return jaw == 0 || jaw > shut.opened.size() ? shut : shut.opened[jaw - 1];
  }
  const ToolModel& model_of(const ToolState& tool) const {
    return model_at(tool.instrument, jaw_step(tool.jaw));
  }
  /// How far from the tool its shade falls on bone: by closeness, and as a shadow along the light.
  struct ShadeReach {
    double near_m = 0, shadow_m = 0;
  };
  static ShadeReach shade_reach(const ToolModel& tool) {
    return {10 * tool.tip_radius_m, 30 * tool.tip_radius_m};
  }
  static std::vector<Capsule> capsules_along_z(const TriMesh& mesh);
  static Capsule capsule_around(const Aabb& box);
  static std::vector<Capsule> mark_capsules(const RenderSnapshot& snapshot);
  static std::vector<Capsule> rod_capsules(const RenderSnapshot& snapshot);
  std::vector<Capsule> placing_capsules(const RenderSnapshot& snapshot) const;
  std::vector<BenchRod> rods_at_bench(const RenderSnapshot& snapshot) const;
  std::vector<Capsule> bench_capsules(const RenderSnapshot& snapshot) const;
  /// With the program of metal in use.
  void paint_rod(const Capsule& rod, const Eigen::Vector4f& color, const Frame& frame) const;
  void paint_placing(const RenderSnapshot& snapshot, const Frame& frame) const;
  struct LooseModel {
    GpuMesh mesh;
    Capsule around;  ///< in Bone
  };
  std::vector<std::pair<const LooseModel*, const LooseBone*>> loose_of(
      const RenderSnapshot& snapshot, const ViewState& view) const;
  std::vector<Capsule> loose_capsules(const RenderSnapshot& snapshot, const ViewState& view) const;
  void paint_loose(const RenderSnapshot& snapshot, const ViewState& view, const Frame& frame) const;
  static bool shows_hand(const RenderSnapshot& snapshot, const ViewState& view);
  double nearest_bone(const RenderSnapshot& snapshot, const ViewState& view,
                      const Frame& frame) const;
  TileMask shade_tiles(const ToolState& tool, const Frame& frame, int width, int height,
                       double nearest_m) const;
  TileMask bone_tiles(const RenderSnapshot& snapshot, const ViewState& view, const Frame& frame,
                      int width, int height) const;
  struct Level {
    GpuMesh surface;
    double error_m = 0;
  };
  struct Piece {
    GpuMesh facets, lines;
  };
  struct BoneModel {
    std::vector<Level> levels;  ///< the finest, exact one first
    ChangedCubes changed;       ///< of a bone
    HeatTexture heat;           ///< likewise
    std::vector<Piece> pieces;
    Vec3 center_B = Vec3::Zero();
    double radius_m = 0;           ///< of a ball about the centre that holds the bone
    std::vector<ExtentBox> boxes;  ///< that hold it more closely
    Capsule around;
    bool closed = false;
    bool wounded = false;  ///< skin that was cut open
    float line_opacity = 0;
    bool outermost = false;             ///< the skin: drawn over all else that is seen through
    std::vector<std::size_t> rides_on;  ///< bones; of a soft part
    std::optional<LimbCover> cover;     ///< of skin that bends with a knee
    RestLight light;                    ///< of a soft part
    Vec3 middle_B = Vec3::Zero();       ///< of a soft part at rest
    ShadedMesh moved;                   ///< what was last drawn for one that gave way
  };
  /// Models are the bones and after them the soft parts; what follows takes both.
  Pose pose(const RenderSnapshot& snapshot, std::size_t k) const;
  const BoneAppearance& look_of(const ViewState& view, std::size_t k) const;
  bool shows(const RenderSnapshot& snapshot, const ViewState& view, std::size_t k) const;
  static BoneModel make_soft(const Case& the_case, const SoftPart& soft);
  /// Motion of both ends of what bends; the pose twice of what is rigid.
  std::array<Pose, 2> end_poses(const RenderSnapshot& snapshot, std::size_t k) const;
  /// Skin that has been bent far from how it was made is seen through.
  ViewState with_far_covers_clear(const RenderSnapshot& snapshot, ViewState view) const;
  /// How it bends with its limb; none: it is rigid, or has not been bent.
  std::optional<CoverMotion> cover_motion(const RenderSnapshot& snapshot, std::size_t k) const;
  static void set_cover(const Program& program, const LimbCover& cover, const CoverMotion& motion);
  /// Into use: `rigid`, or `bending` where the part bends; its model's matrix is set.
  const Program& begin_part(const Program& rigid, const Program& bending,
                            const RenderSnapshot& snapshot, std::size_t k,
                            const Frame& frame) const;
  /// Bones to draw whose appearance passes, the nearest first.
  template <class Passes>
  std::vector<std::size_t> near_to_far(const RenderSnapshot& snapshot, const ViewState& view,
                                       const Frame& frame, Passes passes) const;
  void set_shared(const Program& program, const ViewState& view, const Frame& frame) const;
  void set_tool_shade(const Program& program, const RenderSnapshot& snapshot, const ViewState& view,
                      const Frame& frame) const;
  void set_felt_colors(const ViewState& view) const;
  bool any_changed() const;
  bool any_heat(const ViewState& view) const;
  static void set_extent(BoneModel& model, const TriMesh& mesh);
  static Aabb extent_of(const BoneModel& model);
  static BoneModel make_bone(const Bone& bone);
  static void make_pieces(BoneModel& model, const Bone& bone);
  /// The coarsest surface that cannot be told from the exact one at its size on the screen.
  const GpuMesh& surface(std::size_t k, const RenderSnapshot& snapshot, const ViewState& view,
                         const Frame& frame) const;
  void draw_surface(std::size_t k, const RenderSnapshot& snapshot, const ViewState& view,
                    const Frame& frame) const;
  void draw_changed(std::size_t k, const RenderSnapshot& snapshot, const Frame& frame) const;
  /// Into the depth buffer alone.
  void paint_depth(std::size_t k, const RenderSnapshot& snapshot, const ViewState& view,
                   const Frame& frame) const;
  void paint_bone(std::size_t k, const RenderSnapshot& snapshot, const ViewState& view,
                  const Frame& frame) const;
  void paint_opaque_bones(const RenderSnapshot& snapshot, const ViewState& view,
                          const Frame& frame) const;
  /// Of the solid bones or of those that are seen through.
  void paint_outlines(const RenderSnapshot& snapshot, const ViewState& view, const Frame& frame,
                      bool clear) const;
  void paint_clear_bones(const RenderSnapshot& snapshot, const ViewState& view,
                         const Frame& frame) const;
  void paint_hulls(const RenderSnapshot& snapshot, const ViewState& view, const Frame& frame) const;
  void paint_tool(const ToolModel& tool, const Pose& X_WT, const Eigen::Vector4f& color,
                  const Frame& frame) const;
  void paint_ghosts(const Frame& frame) const;
  void paint_marks(const RenderSnapshot& snapshot, const Frame& frame) const;
  void paint_mark(const GpuMesh& mesh, const Eigen::Matrix4f& view_from_model,
                  float behind = 0.22f) const;
  void paint_rods(const RenderSnapshot& snapshot, const Frame& frame) const;
  void paint_lines(const RenderSnapshot& snapshot, const Frame& frame) const;

  /// What all painters of a case have in common; never null.
  struct Shared {
    Program bone, changed_bone, depth, metal, mark, ground;
    Program heated_bone, changed_heated_bone;
    Program cover_bone, cover_depth, cover_mark;  ///< of skin that bends
    std::vector<BoneModel> bones;                 ///< and soft parts
    std::vector<Pose> rest_X_WB;                  ///< of the bones
    std::vector<ToolModel> tools;                 ///< by ToolState::instrument; not empty
    std::map<std::uint64_t, LooseModel> loose;
    std::optional<GraftBenchPlan> bench;  ///< of a case that has one
    GpuMesh shaft, head, ball;
    GlVertexArray no_vertices;
    SurfaceChanges changes;
  };
  std::shared_ptr<Shared> shared_ = std::make_shared<Shared>();
  std::vector<ToolState> others_;
  std::vector<GhostTool> ghosts_;
  struct Solid {
    GpuMesh surface;
    Eigen::Vector4f color;
    Aabb box_W;
  };
  static std::vector<Solid> solids_of(std::span<const SolidMark> marks);
  void paint_solid_marks(const std::vector<Solid>& solids, const Frame& frame) const;
  std::vector<Solid> solids_, moving_solids_;
};

/// Where bone k is, if it is to be drawn at all.
bool is_shown(const RenderSnapshot& snapshot, const ViewState& view, std::size_t bone);
const BoneAppearance& appearance(const ViewState& view, std::size_t bone);

}  // namespace osteon
