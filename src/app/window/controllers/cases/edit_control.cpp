#include "window/controllers/cases/edit_control.h"

#include <algorithm>
#include <utility>

#include "cases/xdg.h"
#include "osteon/mesh/measure.h"

namespace osteon {
namespace {

constexpr std::size_t kMostDots = 3000;
constexpr double kWheel_m = 0.0005;  // along the view a notch

}  // namespace

void EditControl::begin() {
  if (edit_ || !live_.run() || !scene_.the_case) return;
  if (live_.recording())  // an exercise is one, too
    return host_.note(ToastKind::kWarning, "While a run is recorded no surface is edited");
  auto begun = BoneEdit::begin(*scene_.the_case, sight_.picked());
  if (!begun) return host_.note(ToastKind::kWarning, begun.error().message());
  edit_ = std::make_unique<BoneEdit>(std::move(*begun));
  drawn_ = 0;
  sight_.keep_outside(true);
  sight_.fly_close_up(sight_.picked());
}

void EditControl::end() {
  if (!edit_) return;
  if (edit_->by_probe() && live_.run()) live_.run()->set_feel({CommandKind::kGrab, 0});
  if (scene_.renderer && scene_.the_case && drawn_ > 0)
    scene_.renderer->set_surface(edit_->bone(), scene_.the_case->bone(edit_->bone()).mesh);
  edit_.reset();
  hover_B_.reset();
  sight_.keep_outside(false);
}

Pose EditControl::pose() const { return sight_.shown().bones.bones[edit_->bone().index].X_WB; }

bool EditControl::poll_pointer(const SceneInput& input) {
  if (!edit_ || !live_.run()) return false;
  const Pose X_WB = pose();
  if (const auto command = edit_->follow(sight_.shown().tool, X_WB))
    live_.run()->set_feel(*command);
  const bool pressed = input.left && !left_was_down_;
  left_was_down_ = input.left;
  if (edit_->by_mouse()) {
    if (!input.left) edit_->release();
    if (input.left) drag(input, X_WB);
    return true;
  }
  hover_B_.reset();
  if (input.over_panels || live_.probe_held() || edit_->by_probe() || sight_.dragging())
    return false;
  const SceneSight::PicturePoint at = sight_.in_picture(input.x, input.y);
  const SurfacePoint under =
      scene_.renderer->pick_point(sight_.shown(), sight_.view(), sight_.viewport(), at.x, at.y);
  if (under.bone != edit_->bone()) return false;
  hover_B_ = X_WB.inverse() * under.p_W;
  if (!pressed) return false;
  edit_->grab(*hover_B_);
  moved_C_.setZero();
  return true;
}

// In the plane of the view, at the depth of the grabbed vertex; the wheel moves along the view.
void EditControl::drag(const SceneInput& input, const Pose& X_WB) {
  const Camera& camera = sight_.view().camera;
  const Vec3 at_W = X_WB * edit_->edit().grabbed_at();
  const double scale = metres_per_pixel(camera, sight_.viewport(), at_W);
  moved_C_ += Vec3(scale * input.dx, -scale * input.dy, -kWheel_m * input.wheel);
  edit_->drag(X_WB.q.conjugate() * (camera.q_WC * moved_C_));
}

void EditControl::show() {
  if (!edit_ || drawn_ == edit_->version()) return;
  drawn_ = edit_->version();
  scene_.renderer->set_surface(edit_->bone(), edit_->edit().mesh());
}

void EditControl::apply(const EditRequests& requests) {
  if (requests.begin) begin();
  if (!edit_) return;
  if (requests.selection) edit_->set_selection(*requests.selection);
  if (requests.undo) edit_->undo();
  if (requests.redo) edit_->redo();
  if (requests.save && !save_) {
    edit_->release();
    const std::string& bone = scene_.the_case->bone(edit_->bone()).name;
    save_ = std::make_unique<SideJob<std::filesystem::path>>(
        save_edit(scene_.wanted_source(), bone, edit_->edit().mesh(),
                  dated_file(data_home_dir() / "cases", bone + "-edited", "")));
  }
  if (requests.leave && !save_) end();
}

void EditControl::poll_save() {
  if (!save_ || !save_->done()) return;
  const Result<std::filesystem::path> saved = save_->take();
  save_.reset();
  if (!saved) return host_.note(ToastKind::kError, saved.error().message());
  host_.note(ToastKind::kInfo, "Saved as " + saved->string());
  if (edit_) edit_->mark_saved();
  if (!cases_.loading()) cases_.open({saved->string(), {}, nullptr});
}

EditModel EditControl::model() const {
  EditModel model;
  model.can_begin =
      live_.run() && !live_.recording() && sight_.picked().valid() && !live_.probe_held();
  if (!edit_) return model;
  const MeshEdit& edit = edit_->edit();
  model.on = true;
  model.bone = scene_.the_case->bone(edit_->bone()).name;
  std::replace(model.bone.begin(), model.bone.end(), '_', ' ');
  model.selection = edit_->selection();
  model.grabbed = edit.is_grabbed();
  model.displacement_mm = 1000 * edit.displacement().norm();
  model.volume_cm3 = 1e6 * volume(edit.mesh());
  model.undo_steps = edit.undo_steps();
  model.redo_steps = edit.redo_steps();
  model.forgotten_steps = edit.forgotten_steps();
  model.changed = edit.is_changed();
  model.saving = save_ != nullptr;
  EditFindings findings = edit_->findings();
  if (edit.is_grabbed()) findings = {edit.turned_now(), {}};
  model.sound = findings.sound();
  model.findings = findings.summary();
  model.dots = dots();
  return model;
}

// Of those that face the viewer.
std::vector<EditDot> EditControl::dots() const {
  std::vector<EditDot> dots;
  const MeshEdit& edit = edit_->edit();
  if (!edit.is_grabbed() && !hover_B_) return dots;
  const std::vector<SoftWeight> selected =
      edit.is_grabbed() ? edit.selected() : edit_->preview(*hover_B_);
  const Pose X_WB = pose();
  const Vec3 eye_B = X_WB.inverse() * sight_.view().camera.eye_W();
  const std::vector<Vec3> normals = vertex_normals(edit.mesh());
  const SceneSight::Projector onto = sight_.projector();
  for (const SoftWeight& s : selected) {
    const Vec3& p_B = edit.mesh().vertices[s.vertex];
    if (normals[s.vertex].dot(eye_B - p_B) <= 0) continue;
    const auto at = onto(X_WB * p_B);
    if (!at) continue;
    dots.push_back(
        {static_cast<float>(at->x()), static_cast<float>(at->y()), static_cast<float>(s.weight)});
    if (dots.size() == kMostDots) break;
  }
  return dots;
}

}  // namespace osteon
