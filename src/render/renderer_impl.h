#pragma once

#include <optional>

#include "gl/render_target.h"
#include "osteon/render/renderer.h"
#include "scene_painter.h"
#include "surface/edge_smoother.h"
#include "view/picker.h"

namespace osteon {

/// What a picture of one size is drawn into.
struct PictureTargets {
  RenderTarget drawn{}, resolved{};
  RenderTarget ground{};  ///< drawn once a size: its shader costs more than all bones do
  PictureWindow ground_window{};
};

struct Renderer::Impl {
  ScenePainter painter;
  std::shared_ptr<const EdgeSmoother> smoother;
  std::shared_ptr<Picker> picker;
  std::string device;
  bool software = false;
  PictureTargets full{}, coarse{};
  RenderTarget still{};
  double moving_detail = 1;  ///< see Renderer::set_moving_detail
  int coarse_left = 0;       ///< pictures after a coarse one that stay coarse though all rests
  bool drew_all = true;      ///< the last picture was drawn whole

  /// What does not move, as it was when it was last seen to change.
  struct Kept {
    ViewState view;
    BoneSnapshot bones;
    int width = 0, height = 0;
    std::uint64_t surfaces = 0;  ///< ScenePainter::version; where they changed since, tiles are
                                 ///< drawn over it
  };
  std::optional<Kept> kept{};
  RenderTarget kept_picture{};  ///< of `kept`, without the tool
  bool kept_ready = false;
  TileMask changed{};                   ///< where `full.resolved` is not `kept_picture`
  std::optional<ToolState> composed{};  ///< the tool that `full.resolved` shows over `kept_picture`
  LooseBones composed_loose{};
  std::vector<ToolState> composed_others{};
  std::vector<GhostTool> composed_ghosts{};
  ViewState composed_view{};
  std::uint64_t composed_surfaces = 0;  ///< ScenePainter::version
  int surfaces_rest = 0;                ///< pictures in a row in which no surface changed

  /// Draws one tile of the picture into the viewport of `framebuffer`.
  bool draw_tile(const RenderSnapshot& snapshot, const ViewState& view, double aspect,
                 const PictureWindow& window, GLuint framebuffer, const Viewport& viewport);
  bool paint_scene(PictureTargets& targets, const RenderSnapshot& snapshot, const ViewState& view,
                   const Frame& frame, int width, int height, int samples);
  bool ensure_ground(PictureTargets& targets, const PictureWindow& window, int width, int height);
  /// Draws all of it in fewer pixels and spreads them over the viewport.
  bool draw_coarse(const RenderSnapshot& snapshot, const ViewState& view, GLuint framebuffer,
                   const Viewport& viewport);
  void smooth_and_show(PictureTargets& targets, const Frame& frame, const Aabb& content,
                       GLuint framebuffer, const Viewport& viewport);

  /// Draws what differs from the picture before; the whole where too much does.
  void draw_changes(const RenderSnapshot& snapshot, const ViewState& view, GLuint framebuffer,
                    const Viewport& viewport);
  bool stands_still(const RenderSnapshot& snapshot, const ViewState& still_view, int width,
                    int height) const;
  bool keep(const RenderSnapshot& snapshot, const ViewState& still_view, int width, int height);
  void restore_kept();
  bool compose(const RenderSnapshot& snapshot, const ViewState& view, int width, int height);
  void paint_tiles(const RenderSnapshot& snapshot, const ViewState& view, Frame frame,
                   const TileMask& tiles);
};

/// Pixels of a picture that may show something else than ground, without its outermost ones: they
/// lack a neighbour to be compared with.
Viewport busy_part(const Frame& frame, const Aabb& content, int width, int height);

void copy_color(const RenderTarget& from, const RenderTarget& to);
/// The same place in both.
void copy_color(const RenderTarget& from, const RenderTarget& to, const Viewport& part);

/// Copies a finished picture into the viewport; one that is larger is averaged.
void show(const RenderTarget& picture, GLuint framebuffer, const Viewport& viewport);

}  // namespace osteon
