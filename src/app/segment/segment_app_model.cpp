#include <cmath>
#include <cstdio>

#include "osteon/scene/bone_names.h"
#include "osteon/scene/build_case.h"
#include "segment/segment_app.h"

namespace osteon {
namespace {

std::string shape_text(const GridFrame& frame) {
  const Vec3 mm = frame.spacing_m * 1000;
  char text[96];
  std::snprintf(text, sizeof text, "%d x %d x %d voxels of %.3g x %.3g x %.3g mm", frame.size[0],
                frame.size[1], frame.size[2], mm.x(), mm.y(), mm.z());
  return text;
}

}  // namespace

LoadingModel SegmentApp::job_model(const LoadProgress& progress) {
  LoadingModel model;
  model.what = progress.what;
  model.fraction = progress.fraction;
  model.seconds_left = progress.seconds_left;
  model.can_cancel = true;
  return model;
}

SegmentModel SegmentApp::build_model() const {
  SegmentModel model;
  const ImVec2 size = ImGui::GetIO().DisplaySize;
  model.width = size.x;
  model.height = size.y;
  model.scale = ui_->scale();
  model.toasts = toasts_.shown();
  model.help_open = help_open_;
  model.panels_open = panels_open_;
  model.asks_to_close = asks_to_close_;
  model.returns = order_.returns;
  model.chooser = chooser_;
  if (!segmenting_) {
    model.phase = failure_.empty() ? UiPhase::kLoading : UiPhase::kFailed;
    model.loading.failure = failure_;
    if (opening_) model.loading = job_model(opening_->progress());
    return model;
  }
  if (suggesting_) model.job = job_model(suggesting_->progress());
  if (saving_) model.job = job_model(saving_->progress());
  const LabelEdit& edit = segmenting_->edit();
  model.title = order_.scan.source.filename().string();
  model.shape = shape_text(edit.labels().frame);
  model.tools = segmenting_->tools();
  model.grey = segmenting_->grey();
  model.values = values_;
  model.chosen = segmenting_->chosen();
  model.known_names = known_bone_names();
  model.under_pointer = under_pointer();
  model.has_solid = solid_ && solid_->shows_anything();
  model.solid_busy = solid_ && solid_->busy();
  model.undo_steps = edit.undo_steps();
  model.redo_steps = edit.redo_steps();
  model.undo_what = edit.undo_what();
  model.redo_what = edit.redo_what();
  model.changed = edit.is_changed();
  model.out = order_.out.string();
  model.saved = holds_saved_case();
  fill_panes(model);
  fill_bones(model);
  return model;
}

void SegmentApp::fill_bones(SegmentModel& model) const {
  const LabelEdit& edit = segmenting_->edit();
  const double voxel_cm3 = 1e6 * edit.labels().frame.voxel_volume_m3();
  for (const auto& [label, bone] : edit.bones())
    model.bones.push_back({label, bone.name, fma_id_of(bone.name), bone.voxels,
                           voxel_cm3 * static_cast<double>(bone.voxels),
                           segmenting_->is_shown(label)});
}

void SegmentApp::fill_panes(SegmentModel& model) const {
  const GridFrame& frame = segmenting_->edit().labels().frame;
  const double ratio = window_->pixel_ratio();
  const auto& cross = segmenting_->cross();
  const auto screen = [&](std::size_t p, const Vec3& voxel) {
    const PanePoint at =
        pane_point(segmenting_->planes()[p], frame, segmenting_->windows()[p], voxel);
    return PanePoint{at.x / ratio, at.y / ratio};
  };
  for (std::size_t p = 0; p < model.panes.size(); ++p) {
    SlicePane& pane = model.panes[p];
    pane.plane = segmenting_->planes()[p];
    pane.image = textures_[p].handle();
    pane.slice = segmenting_->slice(p);
    pane.slices = frame.size[static_cast<std::size_t>(pane.plane.normal)];
    pane.cross = screen(p, Vec3(cross[0], cross[1], cross[2]));
    pane.px_per_mm = 0.001 / (segmenting_->windows()[p].m_per_px * ratio);
  }
  if (const auto& stroke = segmenting_->split_stroke())
    model.split = SegmentModel::SplitLine{stroke->pane, screen(stroke->pane, stroke->from_voxel),
                                          screen(stroke->pane, stroke->to_voxel)};
}

std::string SegmentApp::under_pointer() const {
  if (!pointer_) return {};
  const LabelEdit& edit = segmenting_->edit();
  const GridFrame& frame = edit.labels().frame;
  const std::size_t p = pointer_->pane;
  const Vec3 at = voxel_at(segmenting_->planes()[p], frame, segmenting_->windows()[p], pointer_->x,
                           pointer_->y, segmenting_->slice(p));
  const int i = static_cast<int>(std::floor(at.x() + 0.5));
  const int j = static_cast<int>(std::floor(at.y() + 0.5));
  const int k = static_cast<int>(std::floor(at.z() + 0.5));
  if (!frame.contains(i, j, k)) return {};
  std::string text = std::to_string(edit.volume().at(i, j, k)) + " HU";
  if (const std::uint16_t label = edit.labels().at(i, j, k))
    text = edit.bones().at(label).name + "   " + text;
  return text;
}

}  // namespace osteon
