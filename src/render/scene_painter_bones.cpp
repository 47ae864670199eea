// How bones and soft parts are painted: solid, clear, outlined, as hulls.
#include <algorithm>
#include <cmath>

#include "osteon/render/felt_colors.h"
#include "scene_painter.h"

namespace osteon {
namespace {

using Color = Eigen::Vector4f;

const Color kAccent(0.31f, 0.76f, 0.97f, 1.0f);

constexpr float kOutline_px = 2.5f;
constexpr double kLevelError_px = 0.30;  // of a coarser surface, in the picture
constexpr double kLevelErrorFine_px = 0.10;
constexpr double kLevelErrorPassing_px = 1.0;
constexpr std::size_t kPieceStep = 4;  // in the row of hull colours: about to the opposite hue

bool is_clear(const BoneAppearance& look) { return look.opacity < 0.995f; }

/// Colours that neighbours can be told apart by: hues a golden angle apart, none of them amber.
Color hull_color(std::size_t bone, float alpha) {
  const double hue = std::fmod(0.52 + 0.381966 * static_cast<double>(bone), 1.0);
  const auto channel = [hue](double shift) {
    const double h = std::abs(std::fmod(hue + shift, 1.0) * 6 - 3) - 1;
    return static_cast<float>(0.42 + 0.52 * std::clamp(h, 0.0, 1.0));
  };
  return {channel(0), channel(2.0 / 3), channel(1.0 / 3), alpha};
}

}  // namespace

template <class Passes>
std::vector<std::size_t> ScenePainter::near_to_far(const RenderSnapshot& snapshot,
                                                   const ViewState& view, const Frame& frame,
                                                   Passes passes) const {
  std::vector<std::pair<double, std::size_t>> by_depth;
  for (std::size_t k = 0; k < shared_->bones.size(); ++k) {
    if (!shows(snapshot, view, k) || !passes(look_of(view, k))) continue;
    const Vec3 center_W = pose(snapshot, k) * shared_->bones[k].center_B;
    if (!cover_motion(snapshot, k) && !in_sight(frame, center_W, shared_->bones[k].radius_m))
      continue;
    const double depth = -(frame.X_CW * center_W).z();
    by_depth.emplace_back(shared_->bones[k].outermost ? -1e300 : depth, k);
  }
  std::sort(by_depth.begin(), by_depth.end());
  std::vector<std::size_t> bones;
  for (const auto& [depth, k] : by_depth) bones.push_back(k);
  return bones;
}

const GpuMesh& ScenePainter::surface(std::size_t k, const RenderSnapshot& snapshot,
                                     const ViewState& view, const Frame& frame) const {
  const BoneModel& bone = shared_->bones[k];
  if (bone.levels.size() == 1) return bone.levels.front().surface;
  const double allowed_px = frame.passing                          ? kLevelErrorPassing_px
                            : view.quality == RenderQuality::kFine ? kLevelErrorFine_px
                                                                   : kLevelError_px;
  const double allowed_m =
      allowed_px * finest_metres_per_pixel(frame, pose(snapshot, k), bone.boxes);
  return surface_within(k, allowed_m);
}

void ScenePainter::draw_surface(std::size_t k, const RenderSnapshot& snapshot,
                                const ViewState& view, const Frame& frame) const {
  const GpuMesh& mesh = surface(k, snapshot, view, frame);
  if (cover_motion(snapshot, k)) return mesh.draw();
  const Pose X_WB = pose(snapshot, k), X_CB = frame.X_CW * X_WB;
  mesh.draw([&](const GpuMesh::Chunk& chunk) {
    return frame.tiles ? in_tiles(frame, X_CB * chunk.center, chunk.radius)
                       : in_sight(frame, X_WB * chunk.center, chunk.radius);
  });
}

void ScenePainter::draw_changed(std::size_t k, const RenderSnapshot& snapshot,
                                const Frame& frame) const {
  if (frame.tiles == nullptr) return shared_->bones[k].changed.draw();
  const Pose X_CB = frame.X_CW * pose(snapshot, k);
  shared_->bones[k].changed.draw([&](const GpuMesh::Chunk& chunk) {
    return in_tiles(frame, X_CB * chunk.center, chunk.radius);
  });
}

void ScenePainter::paint_bone(std::size_t k, const RenderSnapshot& snapshot, const ViewState& view,
                              const Frame& frame) const {
  const BoneAppearance& look = look_of(view, k);
  const HeatTexture& heat = shared_->bones[k].heat;
  const bool heated = view.show_heat && !heat.empty();
  const Program& bone = heated ? shared_->heated_bone : shared_->bone;
  const Program& changed_bone = heated ? shared_->changed_heated_bone : shared_->changed_bone;
  const auto begin = [&](const Program& rigid) {
    const Program& program = begin_part(rigid, shared_->cover_bone, snapshot, k, frame);
    if (heated) heat.show(program);
    program.set("u_wound", shared_->bones[k].wounded ? 1 : 0);
    program.set("u_color", Color(look.color[0], look.color[1], look.color[2],
                                 is_clear(look) ? look.opacity : 1.0f));
  };
  const ChangedCubes& changed = shared_->bones[k].changed;
  if (!changed.empty()) {
    begin(changed_bone);
    changed.hide(changed_bone, is_clear(look));
    draw_surface(k, snapshot, view, frame);
  }
  begin(bone);
  if (changed.empty()) return draw_surface(k, snapshot, view, frame);
  draw_changed(k, snapshot, frame);
}

void ScenePainter::paint_depth(std::size_t k, const RenderSnapshot& snapshot, const ViewState& view,
                               const Frame& frame) const {
  if (!shared_->bones[k].changed.empty()) return;  // its surface is not what is seen everywhere
  begin_part(shared_->depth, shared_->cover_depth, snapshot, k, frame);
  draw_surface(k, snapshot, view, frame);
}

void ScenePainter::set_felt_colors(const ViewState& view) const {
  const char* const names[] = {"u_felt_low", "u_felt_none", "u_felt_high"};
  for (const Program* program : {&shared_->changed_heated_bone, &shared_->heated_bone,
                                 &shared_->changed_bone, &shared_->cover_bone, &shared_->bone}) {
    program->use();
    for (std::size_t k = 0; k < kFeltColors.size(); ++k)
      program->set(names[k],
                   Eigen::Vector3f(kFeltColors[k][0], kFeltColors[k][1], kFeltColors[k][2]));
    program->set("u_felt", view.show_felt ? 1 : 0);
  }
}

/// The nearest first: what they hide is never shaded.
void ScenePainter::paint_opaque_bones(const RenderSnapshot& snapshot, const ViewState& view,
                                      const Frame& frame) const {
  glCullFace(GL_BACK);
  const auto solid = [](const BoneAppearance& look) { return !is_clear(look); };
  const std::vector<std::size_t> order = near_to_far(snapshot, view, frame, solid);
  const auto each = [&](auto&& paint) {
    for (const std::size_t k : order) {
      if (shared_->bones[k].closed) glEnable(GL_CULL_FACE);
      paint(k);
      glDisable(GL_CULL_FACE);
    }
  };
  // Soft parts lie close upon bones, and none of them is always the nearer one. Where few pixels
  // are drawn, a second pass over the triangles costs more than the pixels that it spares.
  const bool layered = std::any_of(order.begin(), order.end(),
                                   [&](std::size_t k) { return k >= shared_->rest_X_WB.size(); });
  if (layered && !frame.passing) {
    glColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
    each([&](std::size_t k) { paint_depth(k, snapshot, view, frame); });
    glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
  }
  shared_->bone.use();
  set_felt_colors(view);
  each([&](std::size_t k) { paint_bone(k, snapshot, view, frame); });
}

/// The bone's back faces, pushed outwards on the screen, show as a line around it.
void ScenePainter::paint_outlines(const RenderSnapshot& snapshot, const ViewState& view,
                                  const Frame& frame, bool clear) const {
  const auto with_outline = [&](const Eigen::Vector2f& outline) {
    for (const Program* mark : {&shared_->cover_mark, &shared_->mark}) {
      mark->use();
      mark->set("u_color", kAccent);
      mark->set("u_form", 0.0f);
      mark->set("u_edge", 0.0f);
      mark->set("u_outline", outline);
    }
  };
  with_outline(frame.pixel_clip * kOutline_px);
  glEnable(GL_CULL_FACE);
  glCullFace(GL_FRONT);
  for (std::size_t k = 0; k < shared_->bones.size(); ++k) {
    const BoneAppearance& look = look_of(view, k);
    if (!look.highlighted || is_clear(look) != clear || !shows(snapshot, view, k)) continue;
    begin_part(shared_->mark, shared_->cover_mark, snapshot, k, frame);
    draw_surface(k, snapshot, view, frame);
  }
  glDisable(GL_CULL_FACE);
  with_outline(Eigen::Vector2f(0, 0));
}

/// Far bones first; of each only the nearest surface, so that folds do not show as stains.
void ScenePainter::paint_clear_bones(const RenderSnapshot& snapshot, const ViewState& view,
                                     const Frame& frame) const {
  std::vector<std::size_t> order = near_to_far(snapshot, view, frame, is_clear);
  std::reverse(order.begin(), order.end());
  shared_->bone.use();
  set_felt_colors(view);
  for (const std::size_t k : order) {
    glColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
    paint_depth(k, snapshot, view, frame);
    glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    glDepthMask(GL_FALSE);
    paint_bone(k, snapshot, view, frame);
    glDepthMask(GL_TRUE);
  }
}

void ScenePainter::paint_hulls(const RenderSnapshot& snapshot, const ViewState& view,
                               const Frame& frame) const {
  shared_->mark.use();
  glDepthMask(GL_FALSE);
  glEnable(GL_CULL_FACE);
  glCullFace(GL_BACK);
  for (std::size_t k = 0; k < shared_->bones.size(); ++k) {
    if (!shows(snapshot, view, k)) continue;
    shared_->mark.set("u_view_from_model", to_matrix(frame.X_CW * pose(snapshot, k)));
    for (std::size_t piece = 0; piece < shared_->bones[k].pieces.size(); ++piece) {
      const std::size_t tone = k + kPieceStep * piece;
      shared_->mark.set("u_color", hull_color(tone, 0.16f));
      shared_->mark.set("u_form", 0.8f);
      shared_->mark.set("u_edge", 0.15f);
      shared_->bones[k].pieces[piece].facets.draw();
      shared_->mark.set("u_color", hull_color(tone, shared_->bones[k].line_opacity));
      shared_->mark.set("u_form", 0.0f);
      shared_->mark.set("u_edge", 0.0f);
      shared_->bones[k].pieces[piece].lines.draw();
    }
  }
  glDisable(GL_CULL_FACE);
  glDepthMask(GL_TRUE);
}

}  // namespace osteon
