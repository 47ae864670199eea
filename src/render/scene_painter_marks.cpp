// What is drawn over the scene: force, contacts, the hand beside its tool, solid marks.
#include <algorithm>
#include <cmath>
#include "osteon/base/turn.h"
#include "osteon/render/felt_colors.h"
#include "osteon/scene/soft_motion.h"
#include "scene_painter.h"

#include "force_arrow.h"
#include "surface/shapes.h"

namespace osteon {
namespace {

using Color = Eigen::Vector4f;

const Color kAmber(1.00f, 0.70f, 0.20f, 1.0f);
constexpr double kGhostFrom_m = 2e-4;     // hand and proxy closer than this are drawn as one
constexpr double kGhostFrom_rad = 0.035;  // 2 degrees
const Color kGhostTint(0.35f, 0.72f, 1.0f, 1.0f);
constexpr float kGhostSeen = 0.02f, kGhostMost = 0.8f;  // opacity
constexpr double kArrowRadius_m = 0.0007;
constexpr double kArrowHeadWidths = 2.4;
constexpr double kContactRadius_m = 0.0006;

bool hand_is_apart(const ToolState& tool) {
  return (tool.X_WD.p - tool.X_WP.p).norm() > kGhostFrom_m ||
         tool.X_WD.q.angularDistance(tool.X_WP.q) > kGhostFrom_rad;
}

/// Turns +z to the unit vector n; any rotation about n will do.
Quat z_towards(const Vec3& n) { return turn_between(Vec3::UnitZ(), n); }

}  // namespace

std::vector<ScenePainter::Solid> ScenePainter::solids_of(std::span<const SolidMark> marks) {
  std::vector<Solid> out;
  for (const SolidMark& mark : marks) {
    const auto& c = mark.color_srgba;
    out.push_back({GpuMesh(plain_shaded(mark.mesh_W)), Color(c[0], c[1], c[2], c[3]),
                   finite_bounds(mark.mesh_W)});
  }
  return out;
}

void ScenePainter::set_marks(std::span<const SolidMark> marks) { solids_ = solids_of(marks); }

void ScenePainter::set_moving_marks(std::span<const SolidMark> marks) {
  moving_solids_ = solids_of(marks);
}

void ScenePainter::set_ghosts(std::span<const GhostTool> ghosts) {
  ghosts_.clear();
  for (const GhostTool& ghost : ghosts)
    if (ghost.opacity >= kGhostSeen && is_finite(ghost.X_WT)) ghosts_.push_back(ghost);
}

/// Never quite solid, so that it is not taken for an instrument that can be felt.
void ScenePainter::paint_ghosts(const Frame& frame) const {
  for (const GhostTool& ghost : ghosts_) {
    Color color = kGhostTint;
    color.w() = std::min(ghost.opacity, kGhostMost);
    paint_tool(model_at(ghost.instrument), ghost.X_WT, color, frame);
  }
}

bool ScenePainter::shows_hand(const RenderSnapshot& snapshot, const ViewState& view) {
  return view.show_hand_ghost && hand_is_apart(snapshot.tool);
}

std::vector<ScenePainter::Capsule> ScenePainter::mark_capsules(const RenderSnapshot& snapshot) {
  const ToolState& tool = snapshot.tool;
  std::vector<Capsule> out;
  for (std::size_t k = 0; k < std::min<std::size_t>(tool.contact_count, kMaxContacts); ++k)
    if (is_finite(tool.contacts[k].p_W))
      out.push_back({tool.contacts[k].p_W, tool.contacts[k].p_W, kContactRadius_m});
  if (const auto arrow = force_arrow(tool))
    out.push_back({arrow->from_W, arrow->from_W + arrow->length_m * arrow->dir_W,
                   kArrowHeadWidths * kArrowRadius_m});
  return out;
}

void ScenePainter::paint_mark(const GpuMesh& mesh, const Eigen::Matrix4f& view_from_model,
                              float behind) const {
  shared_->mark.set("u_view_from_model", view_from_model);
  glDepthMask(GL_FALSE);
  glDepthFunc(GL_GREATER);
  shared_->mark.set("u_color", Color(kAmber.x(), kAmber.y(), kAmber.z(), behind));
  mesh.draw();
  glDepthMask(GL_TRUE);
  glDepthFunc(GL_LEQUAL);
  shared_->mark.set("u_color", kAmber);
  mesh.draw();
}

/// The far side first, so that the inside of a cone is seen through its near side.
void ScenePainter::paint_solid_marks(const std::vector<Solid>& solids, const Frame& frame) const {
  if (solids.empty()) return;
  shared_->mark.use();
  shared_->mark.set("u_form", 0.5f);
  shared_->mark.set("u_edge", 0.25f);
  shared_->mark.set("u_view_from_model", to_matrix(frame.X_CW));
  glEnable(GL_CULL_FACE);
  glDepthMask(GL_FALSE);
  for (const Solid& solid : solids) {
    shared_->mark.set("u_color", solid.color);
    for (const GLenum hidden : {GL_FRONT, GL_BACK}) {
      glCullFace(hidden);
      solid.surface.draw();
    }
  }
  glDepthMask(GL_TRUE);
  glDisable(GL_CULL_FACE);
}

void ScenePainter::paint_marks(const RenderSnapshot& snapshot, const Frame& frame) const {
  shared_->mark.use();
  shared_->mark.set("u_form", 0.75f);
  shared_->mark.set("u_edge", 0.0f);
  glEnable(GL_CULL_FACE);
  glCullFace(GL_BACK);
  const ToolState& tool = snapshot.tool;
  for (std::size_t k = 0; k < std::min<std::size_t>(tool.contact_count, kMaxContacts); ++k) {
    const Pose X_CM = frame.X_CW * Pose{tool.contacts[k].p_W, Quat::Identity()};
    if (is_finite(X_CM))
      paint_mark(shared_->ball, scaled(X_CM, kContactRadius_m, kContactRadius_m));
  }
  if (const auto arrow = force_arrow(tool)) {
    const double head = std::min(5 * kArrowRadius_m, 0.6 * arrow->length_m);
    const Pose X_WA{arrow->from_W, z_towards(arrow->dir_W)};
    const Pose X_AH{Vec3(0, 0, arrow->length_m - head), Quat::Identity()};
    paint_mark(shared_->shaft, scaled(frame.X_CW * X_WA, kArrowRadius_m, arrow->length_m - head));
    paint_mark(shared_->head,
               scaled(frame.X_CW * X_WA * X_AH, kArrowHeadWidths * kArrowRadius_m, head));
  }
  glDisable(GL_CULL_FACE);
}

}  // namespace osteon
