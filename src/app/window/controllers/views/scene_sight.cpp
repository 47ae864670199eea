#include "window/controllers/views/scene_sight.h"

#include <algorithm>
#include <cmath>

#include "cases/felt_choice.h"
#include "osteon/physics/soft_setup.h"
#include "ui/label.h"
#include "window/controllers/cases/remembered_looks.h"
#include "window/ui_model.h"

namespace osteon {
namespace {

constexpr double kScopeAhead_m = 0.02;  // where a hand moves as far as its picture does

const Pane* find_pane(const std::vector<Pane>& panes, PaneKind kind) {
  const auto at = std::find_if(panes.begin(), panes.end(),
                               [kind](const Pane& pane) { return pane.kind == kind; });
  return at == panes.end() ? nullptr : &*at;
}

// Upright as the views of the buttons, or as near to it as the way there lets it be.
Camera ordered_camera(const Camera& from, const WindowOrder& order, const Vec3& up_W) {
  const auto point = [](const std::vector<double>& mm) {
    return Vec3(0.001 * Vec3(mm[0], mm[1], mm[2]));
  };
  Camera camera = from;
  camera.target_W = point(order.toward_mm);
  const Vec3 back_W = point(order.eye_mm) - camera.target_W;
  camera.distance_m = back_W.norm();
  const bool along = back_W.normalized().cross(up_W).norm() < 0.01;
  camera.q_WC = look_rotation(back_W, along ? back_W.unitOrthogonal() : up_W);
  return camera;
}

}  // namespace

void SceneSight::begin_case(bool same_case) {
  const ViewState before = view_;
  const BoneId picked = picked_;
  recall();
  if (!same_case) return;
  view_ = before;
  picked_ = picked;
}

void SceneSight::show_what_gives_way(const SoftSetup* setup) {
  const auto show = [this](std::size_t soft) {
    if (soft < view_.softs.size()) view_.softs[soft].visible = true;
  };
  for (std::size_t i = 0; setup && i < setup->solids.size(); ++i) show(setup->solids[i].soft);
  for (std::size_t i = 0; setup && i < setup->bands.size(); ++i) show(setup->bands[i].soft);
  if (!setup || setup->skins.empty() || setup->skins[0].soft >= view_.softs.size()) return;
  show(setup->skins[0].soft);
  view_.softs[setup->skins[0].soft].opacity = 1;  // its cuts are seen, not through it
}

void SceneSight::recall() {
  const Case& the_case = *scene_.the_case;
  view_ = default_view(the_case);
  view_.camera = preset_camera(ViewPreset::kDorsal, the_case, viewport().aspect(), covered_edges());
  recall_looks(host_.settings, scene_.source, the_case, view_);
  recall_light(host_.settings, view_);
  view_.show_felt = view_.show_felt || host_.order.felt;
  view_.show_heat = view_.show_heat || host_.order.heat;
  if (host_.order.softs)
    for (BoneAppearance& look : view_.softs) look.visible = true;
  show_what_gives_way(scene_.softs.setup.get());
  if (host_.order.close_up)
    view_.camera =
        close_up_camera(view_.camera, the_case, {}, viewport().aspect(), covered_edges());
  const Vec3 up_W = anatomical_frame(the_case).distal_W;
  if (!host_.order.eye_mm.empty()) view_.camera = ordered_camera(view_.camera, host_.order, up_W);
  control_ = CameraControl(up_W);
  shown_ = {rest_snapshot(the_case), {}};
  hovered_ = picked_ = hovered_row_ = {};
}

void SceneSight::look_at_all() {
  view_.camera =
      preset_camera(ViewPreset::kDorsal, *scene_.the_case, viewport().aspect(), covered_edges());
}

void SceneSight::fly_close_up(BoneId bone) {
  fly_to(
      close_up_camera(view_.camera, *scene_.the_case, bone, viewport().aspect(), covered_edges()));
}

void SceneSight::apply(const UiRequests& requests) {
  hovered_row_ = requests.hovered_row;
  if (requests.view) {
    const Camera camera = view_.camera;
    view_ = *requests.view;
    view_.camera = camera;
  }
  if (requests.picked_row.valid())
    picked_ = picked_ == requests.picked_row ? BoneId{} : requests.picked_row;
  if (requests.preset)
    fly_to(preset_camera(*requests.preset, *scene_.the_case, viewport().aspect(), covered_edges()));
  if (requests.close_up) fly_close_up(picked_);
}

std::vector<Pane> SceneSight::panes() const {
  const AppSettings& settings = host_.settings;
  const ImVec2 size = ImGui::GetIO().DisplaySize;
  const float scale = host_.ui->scale();
  const UiLayout layout =
      make_layout(size.x, size.y, scale, settings.panels_open, host_.left_card());
  UiRect free = layout.picture;
  if (settings.panels_open && this->layout() != PictureLayout::kOutside) {
    const float gap = std::round(8 * scale);
    free.x = layout.left.right() + gap;
    free.w = std::max(1.0f, layout.right.x - gap - free.x);
    free.y += gap;
    free.h = std::max(1.0f, free.h - 2 * gap);
  }
  return panes_of(this->layout(), free, scale, scene_.views.has_shot());
}

Viewport SceneSight::pixels_of(const UiRect& r) const {
  const double ratio = host_.window->pixel_ratio();
  const auto px = [ratio](float v) {
    return static_cast<int>(std::lround(static_cast<double>(v) * ratio));
  };
  return {px(r.x), px(ImGui::GetIO().DisplaySize.y - r.bottom()), px(r.w), px(r.h)};
}

bool SceneSight::shows_outside() const {
  return layout() == PictureLayout::kOutside || layout() == PictureLayout::kAll;
}

Viewport SceneSight::viewport() const {
  const std::vector<Pane> all = panes();
  const Pane* outside = find_pane(all, PaneKind::kOutside);
  return pixels_of(outside ? outside->area : all.front().area);
}

// The cards float over the picture's sides.
CoveredEdges SceneSight::covered_edges() const {
  if (!host_.settings.panels_open || layout() != PictureLayout::kOutside) return {};
  const ImVec2 size = ImGui::GetIO().DisplaySize;
  const UiLayout layout = make_layout(size.x, size.y, host_.ui->scale(), true, host_.left_card());
  const double width = std::max(1.0, static_cast<double>(layout.picture.w));
  const double left = static_cast<double>(layout.left.right()) / width;
  const double right = static_cast<double>(layout.picture.right() - layout.right.x) / width;
  return {left, right, 0, 0};
}

SceneSight::PicturePoint SceneSight::in_picture(double x, double y) const {
  const Viewport v = viewport();
  PicturePoint at{x - v.x, y - (host_.pixels().height - v.y - v.height), false};
  at.inside = at.x >= 0 && at.y >= 0 && at.x < v.width && at.y < v.height;
  return at;
}

SceneSight::Projector::Projector(const SceneSight& sight)
    : camera_(sight.view_.camera),
      viewport_(sight.viewport()),
      shown_(sight.shows_outside()),
      ratio_(sight.host_.window->pixel_ratio()),
      below_(sight.host_.pixels().height - viewport_.y - viewport_.height) {}

std::optional<Vec3> SceneSight::Projector::operator()(const Vec3& p_W) const {
  const auto at = shown_ ? project(camera_, viewport_, p_W) : std::nullopt;
  if (!at) return std::nullopt;
  return Vec3((at->x + viewport_.x) / ratio_, (at->y + below_) / ratio_, 0);
}

Camera SceneSight::hand_camera() const {
  const bool through = layout() == PictureLayout::kScope || layout() == PictureLayout::kAll;
  const auto scope = through ? scene_.views.scope_camera() : std::nullopt;
  if (!scope) return view_.camera;
  Camera camera = view_.camera;
  camera.q_WC = scope->X_WC().q;
  camera.orthographic = true;
  camera.vertical_fov_rad = 2 * scope->half_field_rad();
  camera.distance_m = kScopeAhead_m;
  return camera;
}

void SceneSight::move_camera(const SceneInput& input) {
  view_.camera = control_.update(view_.camera, input, viewport());
}

void SceneSight::pick_under_pointer(const SceneInput& input, bool free) {
  pointer_x_ = input.x;
  pointer_y_ = input.y;
  hovered_ = {};
  // A pointer that merely lies there points at nothing.
  pointer_moved_ = pointer_moved_ || input.dx != 0 || input.dy != 0;
  if (!pointer_moved_ || !free || control_.dragging() || !shows_outside()) return;
  const PicturePoint at = in_picture(input.x, input.y);
  if (!at.inside) return;
  hovered_ = scene_.renderer->pick(shown_, view_, viewport(), at.x, at.y);
  if (control_.clicked()) picked_ = hovered_ == picked_ ? BoneId{} : hovered_;
}

void SceneSight::highlight(ViewState& view) const {
  for (const BoneId id : {hovered_, hovered_row_, picked_})
    if (id.index < view.bones.size()) view.bones[id.index].highlighted = true;
}

void SceneSight::set_tray(const std::vector<std::string>& names, const Tray& tools,
                          std::span<const Instrument> instruments) {
  if (scene_.renderer) scene_.renderer->set_tray(tools);
  if (auto told = scene_.views.set_tray(names, tools, instruments); !told)
    host_.note(ToastKind::kWarning, told.error().message());
}

void SceneSight::describe(UiModel& model) const {
  model.view = view_;
  model.hovered = hovered_;
  model.picked = picked_;
  const double ratio = host_.window->pixel_ratio();
  model.pointer_x = static_cast<float>(pointer_x_ / ratio);
  model.pointer_y = static_cast<float>(pointer_y_ / ratio);
  model.time_s = shown_.tool.time_s;
}

}  // namespace osteon
