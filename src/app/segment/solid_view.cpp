#include "segment/solid_view.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "osteon/base/file.h"
#include "osteon/scene/tool.h"
#include "segment/label_color.h"

namespace osteon {
namespace {

constexpr double kRoom = 1.15;  // around the bones

Camera camera_on(const Aabb& box_W, const Camera& before) {
  Camera camera = before;
  camera.target_W = box_W.center();
  const double radius_m = std::max(0.005, 0.5 * box_W.extent().norm());
  camera.distance_m = kRoom * radius_m / std::sin(0.5 * camera.vertical_fov_rad);
  return camera;
}

}  // namespace

Result<std::unique_ptr<SolidView>> SolidView::create(const GridFrame& frame) {
  const auto data = find_data_dir();
  if (!data) return tl::unexpected(data.error());
  Case empty;
  empty.bones.resize(kMaxBones);
  auto renderer = Renderer::create(empty, make_wrist_probe(), *data, PreparedCase{});
  if (!renderer) return tl::unexpected(renderer.error());
  std::unique_ptr<SolidView> made(new SolidView(std::move(*renderer)));
  made->snapshot_.bones.count = kMaxBones;
  ViewState& view = made->view_;
  view.bones.assign(kMaxBones, BoneAppearance{.visible = false});
  view.show_proxy = view.show_force = view.show_hand_ghost = false;
  Aabb scan_P;
  for (int corner = 0; corner < 8; ++corner)
    scan_P.include(
        frame.point_P(Vec3(corner & 1 ? frame.size[0] - 1 : 0, corner & 2 ? frame.size[1] - 1 : 0,
                           corner & 4 ? frame.size[2] - 1 : 0)));
  // From the front, head up.
  view.camera.q_WC = look_rotation(-Vec3::UnitY(), Vec3::UnitZ());
  view.camera = camera_on(scan_P, view.camera);
  return made;
}

bool SolidView::shows_anything() const {
  return std::any_of(slots_.begin(), slots_.end(),
                     [](const Slot& s) { return s.label != 0 && s.drawn; });
}

SolidView::Slot* SolidView::slot_of(std::uint16_t label) {
  const auto slot = std::find_if(slots_.begin(), slots_.end(),
                                 [label](const Slot& s) { return s.label == label; });
  return slot == slots_.end() ? nullptr : &*slot;
}

SolidView::Slot* SolidView::slot_for(std::uint16_t label) {
  if (Slot* slot = slot_of(label)) return slot;
  Slot* slot = slot_of(0);
  if (slot) slot->label = label;
  return slot;
}

void SolidView::drop_gone(const LabelEdit& edit) {
  for (Slot& slot : slots_)
    if (slot.label != 0 && (!edit.has(slot.label) || edit.bones().at(slot.label).voxels == 0))
      slot = {};
}

void SolidView::take_surface(const LabelEdit& edit) {
  if (!job_ || !job_->done()) return;
  auto surface = job_->take();
  job_.reset();
  if (!edit.has(job_label_)) return;
  Slot* slot = slot_for(job_label_);
  if (!slot) return;
  slot->version = job_version_;
  slot->drawn = surface.has_value();
  if (!surface) return;
  slot->box_W = {};
  for (const Vec3& p : surface->mesh_P.vertices) slot->box_W.include(p);
  renderer_.set_surface(BoneId{static_cast<std::uint32_t>(slot - slots_.data())}, surface->mesh_P);
  if (!steered_) look_at_all();
}

bool SolidView::is_due(const LabelEdit& edit, std::uint16_t label) {
  const EditedLabel& bone = edit.bones().at(label);
  if (bone.voxels == 0) return false;
  const Slot* slot = slot_of(label);
  return slot ? slot->version != bone.version : slot_of(0) != nullptr;
}

// The chosen bone comes first: it is the one that the user looks at.
void SolidView::begin_next(const Segmenting& segmenting) {
  const LabelEdit& edit = segmenting.edit();
  if (edit.in_step()) return;
  std::uint16_t next = 0;
  if (edit.has(segmenting.chosen()) && is_due(edit, segmenting.chosen()))
    next = segmenting.chosen();
  for (const auto& [label, bone] : edit.bones())
    if (next == 0 && is_due(edit, label)) next = label;
  busy_ = job_ || next != 0;
  if (job_ || next == 0) return;
  job_label_ = next;
  job_version_ = edit.bones().at(next).version;
  auto order = std::make_shared<PreviewOrder>(preview_order(edit, next, segmenting.levels()));
  job_ = std::make_unique<SideJob<PreviewSurface>>(
      [order](const Progress&) { return draw_preview(*order); });
}

void SolidView::show_as(const Segmenting& segmenting) {
  for (std::size_t s = 0; s < slots_.size(); ++s) {
    const Slot& slot = slots_[s];
    BoneAppearance& look = view_.bones[s];
    look.visible = slot.label != 0 && slot.drawn && segmenting.is_shown(slot.label);
    if (slot.label != 0) look.color = label_color_rgb(slot.label);
    look.highlighted = slot.label != 0 && slot.label == segmenting.chosen();
  }
}

void SolidView::update(const Segmenting& segmenting) {
  drop_gone(segmenting.edit());
  take_surface(segmenting.edit());
  begin_next(segmenting);
  show_as(segmenting);
}

void SolidView::look_at_all() {
  Aabb all;
  for (const Slot& slot : slots_)
    if (slot.label != 0 && slot.drawn && !slot.box_W.empty()) {
      all.include(slot.box_W.lo);
      all.include(slot.box_W.hi);
    }
  if (!all.empty()) view_.camera = camera_on(all, view_.camera);
}

std::uint16_t SolidView::steer(const SceneInput& input, const Viewport& viewport) {
  view_.camera = control_.update(view_.camera, input, viewport);
  steered_ = steered_ || control_.dragging() || input.wheel != 0;
  if (!control_.clicked()) return 0;
  const BoneId bone = renderer_.pick(snapshot_, view_, viewport, input.x, input.y);
  return bone.index < slots_.size() ? slots_[bone.index].label : std::uint16_t{0};
}

void SolidView::draw(const Viewport& viewport) { renderer_.draw(snapshot_, view_, viewport); }

}  // namespace osteon
