#include <algorithm>
#include <utility>

#include "cases/xdg.h"
#include "osteon/mesh/measure.h"
#include "window/window_app.h"

namespace osteon {
namespace {

constexpr std::size_t kMostDots = 3000;
constexpr double kWheel_m = 0.0005;  // along the view a notch

}  // namespace

void WindowApp::begin_edit() {
  if (edit_ || !live_ || !case_) return;
  auto begun = BoneEdit::begin(*case_, picked_);
  if (!begun) return note(ToastKind::kWarning, begun.error().message());
  edit_ = std::make_unique<BoneEdit>(std::move(*begun));
  edit_drawn_ = 0;
  control_.fly_to(view_.camera, close_up_camera(view_.camera, *case_, picked_, viewport().aspect(),
                                                covered_edges()));
}

// What was not saved is put back.
void WindowApp::end_edit() {
  if (!edit_) return;
  if (edit_->by_probe() && live_) live_->set_feel({CommandKind::kGrab, 0});
  if (renderer_ && case_ && edit_drawn_ > 0)
    renderer_->set_surface(edit_->bone(), case_->bone(edit_->bone()).mesh);
  edit_.reset();
  edit_hover_.reset();
}

Pose WindowApp::edited_pose() const { return shown_.bones.bones[edit_->bone().index].X_WB; }

// True while the pointer drags the bone, not the camera.
bool WindowApp::poll_edit(const SceneInput& input) {
  if (!edit_ || !live_) return false;
  const Pose X_WB = edited_pose();
  if (const auto command = edit_->follow(shown_.tool, X_WB)) live_->set_feel(*command);
  const bool pressed = input.left && !edit_left_was_down_;
  edit_left_was_down_ = input.left;
  if (edit_->by_mouse()) {
    if (!input.left) edit_->release();
    if (input.left) drag_edit(input, X_WB);
    return true;
  }
  edit_hover_.reset();
  if (input.over_panels || probe_held_ || edit_->by_probe() || control_.dragging()) return false;
  const Viewport v = viewport();
  int width = 0, height = 0;
  window_->framebuffer_size(width, height);
  const SurfacePoint under =
      renderer_->pick_point(shown_, view_, v, input.x - v.x, input.y - (height - v.y - v.height));
  if (under.bone != edit_->bone()) return false;
  edit_hover_ = X_WB.inverse() * under.p_W;
  if (!pressed) return false;
  edit_->grab(*edit_hover_);
  edit_moved_C_.setZero();
  return true;
}

// In the plane of the view, at the depth of the grabbed vertex; the wheel moves along the view.
void WindowApp::drag_edit(const SceneInput& input, const Pose& X_WB) {
  const Vec3 at_W = X_WB * edit_->edit().grabbed_at();
  const double scale = metres_per_pixel(view_.camera, viewport(), at_W);
  edit_moved_C_ += Vec3(scale * input.dx, -scale * input.dy, -kWheel_m * input.wheel);
  edit_->drag(X_WB.q.conjugate() * (view_.camera.q_WC * edit_moved_C_));
}

void WindowApp::show_edit() {
  if (!edit_ || edit_drawn_ == edit_->version()) return;
  edit_drawn_ = edit_->version();
  renderer_->set_surface(edit_->bone(), edit_->edit().mesh());
}

void WindowApp::apply_edit(const EditRequests& requests) {
  if (requests.begin) begin_edit();
  if (!edit_) return;
  if (requests.selection) edit_->set_selection(*requests.selection);
  if (requests.undo) edit_->undo();
  if (requests.redo) edit_->redo();
  if (requests.save && !edit_save_) {
    edit_->release();
    const std::string& bone = case_->bone(edit_->bone()).name;
    edit_save_ = std::make_unique<SideJob<std::filesystem::path>>(
        save_edit(wanted_source(), bone, edit_->edit().mesh(),
                  dated_file(data_home_dir() / "cases", bone + "-edited", "")));
  }
  if (requests.leave && !edit_save_) end_edit();
}

void WindowApp::poll_edit_save() {
  if (!edit_save_ || !edit_save_->done()) return;
  const Result<std::filesystem::path> saved = edit_save_->take();
  edit_save_.reset();
  if (!saved) return note(ToastKind::kError, saved.error().message());
  note(ToastKind::kInfo, "Saved as " + saved->string());
  if (edit_) edit_->mark_saved();
  open({saved->string(), {}, nullptr});
}

EditModel WindowApp::edit_model() const {
  EditModel model;
  model.can_begin = live_ && !live_->recording() && picked_.valid() && !probe_held_;
  if (!edit_) return model;
  const MeshEdit& edit = edit_->edit();
  model.on = true;
  model.bone = case_->bone(edit_->bone()).name;
  std::replace(model.bone.begin(), model.bone.end(), '_', ' ');
  model.selection = edit_->selection();
  model.grabbed = edit.is_grabbed();
  model.displacement_mm = 1000 * edit.displacement().norm();
  model.volume_cm3 = 1e6 * volume(edit.mesh());
  model.undo_steps = edit.undo_steps();
  model.redo_steps = edit.redo_steps();
  model.forgotten_steps = edit.forgotten_steps();
  model.changed = edit.is_changed();
  model.saving = edit_save_ != nullptr;
  EditFindings findings = edit_->findings();
  if (edit.is_grabbed()) findings = {edit.turned_now(), {}};
  model.sound = findings.sound();
  model.findings = findings.summary();
  model.dots = edit_dots();
  return model;
}

// Of those that face the viewer.
std::vector<EditDot> WindowApp::edit_dots() const {
  std::vector<EditDot> dots;
  const MeshEdit& edit = edit_->edit();
  if (!edit.is_grabbed() && !edit_hover_) return dots;
  const std::vector<SoftWeight> selected =
      edit.is_grabbed() ? edit.selected() : edit_->preview(*edit_hover_);
  const Pose X_WB = edited_pose();
  const Viewport v = viewport();
  int width = 0, height = 0;
  window_->framebuffer_size(width, height);
  const double ratio = window_->pixel_ratio();
  const Vec3 eye_B = X_WB.inverse() * view_.camera.eye_W();
  const std::vector<Vec3> normals = vertex_normals(edit.mesh());
  for (const SoftWeight& s : selected) {
    const Vec3& p_B = edit.mesh().vertices[s.vertex];
    if (normals[s.vertex].dot(eye_B - p_B) <= 0) continue;
    const auto at = project(view_.camera, v, X_WB * p_B);
    if (!at) continue;
    dots.push_back({static_cast<float>((at->x + v.x) / ratio),
                    static_cast<float>((at->y + (height - v.y - v.height)) / ratio),
                    static_cast<float>(s.weight)});
    if (dots.size() == kMostDots) break;
  }
  return dots;
}

}  // namespace osteon
