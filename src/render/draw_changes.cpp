// Where a processor draws, most of a picture is the one before: bones stand still and the camera
// rests while the tool moves. What stands still is kept as a picture; the tiles that the tool
// reaches are drawn anew over it, in full, so that the result is that of drawing everything.
// The same goes for a surface that changes: the tiles where it does are drawn over it too.
// While all moves (the camera, a joint) there is nothing to keep; then fewer pixels may be drawn.
#include <algorithm>

#include "renderer_impl.h"

namespace osteon {
namespace {

constexpr double kTooMuch = 0.6;       // share of the picture beyond which keeping saves nothing
constexpr int kSmoothingReach_px = 6;  // of the edge smoothing about a pixel
// A camera that is dragged rests for a picture now and then; sharpening it each time would flicker.
constexpr int kCoarseWhileResting = 4;
// Where surfaces changed is drawn anew in each picture, until they have rested for so many.
constexpr int kRestBeforeKept = 8;

ViewState without_tool(ViewState view) {
  view.show_proxy = view.show_force = view.show_hand_ghost = view.show_loose = false;
  return view;
}

bool same(const Pose& a, const Pose& b) { return a.p == b.p && a.q.coeffs() == b.q.coeffs(); }

bool looks_the_same(const ToolState& a, const ToolState& b) {
  if (!same(a.X_WP, b.X_WP) || !same(a.X_WD, b.X_WD) || a.force_W != b.force_W) return false;
  if (a.contact_count != b.contact_count || a.instrument != b.instrument) return false;
  const std::size_t count = std::min<std::size_t>(a.contact_count, kMaxContacts);
  for (std::size_t k = 0; k < count; ++k)
    if (a.contacts[k].p_W != b.contacts[k].p_W) return false;
  return true;
}

bool looks_the_same(const LooseBones& a, const LooseBones& b) {
  if (a.count != b.count) return false;
  for (std::size_t k = 0; k < std::min<std::size_t>(a.count, kMaxLoose); ++k)
    if (a.bones[k].shape != b.bones[k].shape || !same(a.bones[k].X_WB, b.bones[k].X_WB))
      return false;
  return true;
}

bool looks_the_same(const GhostTool& a, const GhostTool& b) {
  return same(a.X_WT, b.X_WT) && a.instrument == b.instrument && a.opacity == b.opacity;
}

Viewport grown(const Viewport& r, int by, int width, int height) {
  const int x = std::max(r.x - by, 0), y = std::max(r.y - by, 0);
  return {x, y, std::min(r.x + r.width + by, width) - x, std::min(r.y + r.height + by, height) - y};
}

/// The smoothing compares with neighbours, which the outermost pixels lack.
Viewport inner(const Viewport& r, int width, int height) {
  const int x = std::max(r.x, 1), y = std::max(r.y, 1);
  return {x, y, std::max(std::min(r.x + r.width, width - 1) - x, 0),
          std::max(std::min(r.y + r.height, height - 1) - y, 0)};
}

}  // namespace

bool Renderer::Impl::stands_still(const RenderSnapshot& snapshot, const ViewState& still_view,
                                  int width, int height) const {
  if (!kept || kept->width != width || kept->height != height) return false;
  if (!(kept->view == still_view) || !painter.knows_changes_since(kept->surfaces)) return false;
  const double aspect = static_cast<double>(width) / height;
  const Frame frame =
      make_frame(still_view, aspect, painter.content(snapshot, still_view), {}, width, height);
  return painter.bones_look_still(kept->bones, snapshot.bones, frame);
}

bool Renderer::Impl::keep(const RenderSnapshot& snapshot, const ViewState& still_view, int width,
                          int height) {
  const Aabb content = painter.content(snapshot, still_view);
  const double aspect = static_cast<double>(width) / height;
  const Frame frame = make_frame(still_view, aspect, content, {}, width, height);
  if (!paint_scene(full, snapshot, still_view, frame, width, height, 0)) return false;
  if (!kept_picture.ensure(width, height, 0) || !full.resolved.ensure(width, height, 0))
    return false;
  copy_color(full.drawn, kept_picture);
  const Viewport busy = busy_part(frame, content, width, height);
  smoother->smooth(full.drawn, kept_picture, {&busy, 1});
  changed = TileMask(width, height);
  changed.mark_all();
  composed.reset();
  kept->bones = snapshot.bones;
  kept->surfaces = painter.version();
  kept_ready = true;
  return true;
}

void Renderer::Impl::restore_kept() {
  for (const Viewport& r : changed.rectangles()) copy_color(kept_picture, full.resolved, r);
  changed = TileMask(kept_picture.width(), kept_picture.height());
}

/// Depth lets pixels pass in the tiles alone: elsewhere it holds the nearest.
void Renderer::Impl::paint_tiles(const RenderSnapshot& snapshot, const ViewState& view, Frame frame,
                                 const TileMask& tiles) {
  const int width = full.drawn.width(), height = full.drawn.height();
  std::vector<Viewport> areas;
  for (const Viewport& r : tiles.rectangles())
    areas.push_back(grown(r, kSmoothingReach_px, width, height));
  for (const Viewport& r : areas) copy_color(full.ground, full.drawn, r);
  glBindFramebuffer(GL_FRAMEBUFFER, full.drawn.framebuffer());
  glViewport(0, 0, width, height);
  glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
  glDepthMask(GL_TRUE);
  glClearDepth(0.0);
  glClear(GL_DEPTH_BUFFER_BIT);
  glEnable(GL_SCISSOR_TEST);
  glClearDepth(1.0);
  for (const Viewport& r : areas) {
    glScissor(r.x, r.y, r.width, r.height);
    glClear(GL_DEPTH_BUFFER_BIT);
  }
  const Viewport all = grown(tiles.bounds(), kSmoothingReach_px, width, height);
  frame.drawn << 2.0 * all.x / width - 1, 2.0 * all.y / height - 1,
      2.0 * (all.x + all.width) / width - 1, 2.0 * (all.y + all.height) / height - 1;
  frame.tiles = &tiles;
  glScissor(all.x, all.y, all.width, all.height);
  painter.paint(snapshot, view, frame);
  glDisable(GL_SCISSOR_TEST);
}

bool Renderer::Impl::compose(const RenderSnapshot& snapshot, const ViewState& view, int width,
                             int height) {
  const double aspect = static_cast<double>(width) / height;
  const Frame frame = make_frame(view, aspect, painter.content(snapshot, view), {}, width, height);
  TileMask tiles = painter.moving_tiles(snapshot, view, frame, width, height);
  tiles.add(painter.changed_tiles(kept->surfaces, snapshot, view, frame, width, height));
  if (tiles.share() > kTooMuch) return false;
  restore_kept();
  if (!tiles.empty()) {
    paint_tiles(snapshot, view, frame, tiles);
    std::vector<Viewport> areas;
    for (const Viewport& r : tiles.rectangles()) {
      copy_color(full.drawn, full.resolved, r);
      areas.push_back(inner(r, width, height));
    }
    smoother->smooth(full.drawn, full.resolved, areas);
  }
  changed = std::move(tiles);
  composed = snapshot.tool;
  composed_loose = snapshot.bones.loose;
  composed_surfaces = painter.version();
  composed_others.assign(painter.others().begin(), painter.others().end());
  composed_ghosts.assign(painter.ghosts().begin(), painter.ghosts().end());
  return true;
}

void Renderer::Impl::draw_changes(const RenderSnapshot& snapshot, const ViewState& view,
                                  GLuint framebuffer, const Viewport& viewport) {
  const int width = viewport.width, height = viewport.height;
  const ViewState still_view = without_tool(view);
  const auto draw_all = [&] {
    composed.reset();
    changed = TileMask(width, height);
    changed.mark_all();
    draw_tile(snapshot, view, viewport.aspect(), {}, framebuffer, viewport);
  };
  drew_all = true;
  if (!stands_still(snapshot, still_view, width, height)) {
    kept = Kept{still_view, snapshot.bones, width, height, painter.version()};
    kept_ready = false;
    if (moving_detail >= 1) return draw_all();
    coarse_left = kCoarseWhileResting;
    draw_coarse(snapshot, view, framebuffer, viewport);
    return;
  }
  if (coarse_left > 0) {
    --coarse_left;
    draw_coarse(snapshot, view, framebuffer, viewport);
    return;
  }
  const bool overdrawn = kept_ready && kept->surfaces != painter.version();
  surfaces_rest = overdrawn && composed_surfaces == painter.version() ? surfaces_rest + 1 : 0;
  if (surfaces_rest >= kRestBeforeKept) kept_ready = false;
  if (!kept_ready && !keep(snapshot, still_view, width, height)) return draw_all();
  const auto alike = [](const auto& a, const auto& b) { return looks_the_same(a, b); };
  const auto all_alike = [&](const auto& before, const auto& now) {
    return std::equal(before.begin(), before.end(), now.begin(), now.end(), alike);
  };
  const bool shown = composed && composed_surfaces == painter.version() && composed_view == view &&
                     looks_the_same(*composed, snapshot.tool) &&
                     looks_the_same(composed_loose, snapshot.bones.loose) &&
                     all_alike(composed_others, painter.others()) &&
                     all_alike(composed_ghosts, painter.ghosts());
  if (!shown && !compose(snapshot, view, width, height)) {
    if (overdrawn) kept_ready = false;  // surfaces may have changed over much of it
    return draw_all();
  }
  composed_view = view;
  drew_all = false;
  show(full.resolved, framebuffer, viewport);
}

}  // namespace osteon
