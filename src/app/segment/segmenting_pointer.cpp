// What the pointer does over a slice, tool by tool.
#include <algorithm>
#include <cmath>
#include <utility>

#include "segment/segmenting.h"

namespace osteon {
namespace {

constexpr double kGreyPerPixel_hu = 4;
constexpr double kNarrowest_hu = 20, kWidest_hu = 6000;
constexpr double kWheelZoom = 0.85;

}  // namespace

Result<void> Segmenting::point(const PaneInput& input, const Progress& progress) {
  if (input.pane >= 3) return {};
  if (input.wheel != 0) wheel(input);
  look_around(input);
  const Vec3 voxel = voxel_at(planes_[input.pane], edit_.labels().frame, windows_[input.pane],
                              input.x, input.y, slice(input.pane));
  if (input.pressed) {
    if (auto pressed = press(input, voxel, progress); !pressed) return pressed;
  } else if (input.held) {
    drag(input, voxel);
  }
  return input.released ? release(progress) : Result<void>();
}

// Right drag: brightness and contrast; middle drag, or with Shift: sideways.
void Segmenting::look_around(const PaneInput& input) {
  if (input.dx == 0 && input.dy == 0) return;
  const bool sideways = input.middle_held || (input.right_held && input.shift);
  if (sideways) {
    windows_[input.pane] =
        panned(planes_[input.pane], edit_.labels().frame, windows_[input.pane], input.dx, input.dy);
    ++look_version_;
  } else if (input.right_held) {
    grey_.width_hu =
        std::clamp(grey_.width_hu + kGreyPerPixel_hu * input.dx, kNarrowest_hu, kWidest_hu);
    grey_.level_hu = std::clamp(grey_.level_hu + kGreyPerPixel_hu * input.dy, -1024.0, 3071.0);
    ++look_version_;
  }
}

void Segmenting::wheel(const PaneInput& input) {
  const SlicePlane& plane = planes_[input.pane];
  const GridFrame& frame = edit_.labels().frame;
  if (input.ctrl) {
    windows_[input.pane] = zoomed(plane, frame, windows_[input.pane],
                                  std::pow(kWheelZoom, input.wheel), input.x, input.y);
    ++look_version_;
    return;
  }
  // Away from the user goes to the head, the back and the left.
  const auto normal = axis(plane.normal);
  const int patient = plane.view == SliceView::kAxial     ? 2
                      : plane.view == SliceView::kCoronal ? 1
                                                          : 0;
  const int sign = frame.axes_P(patient, plane.normal) < 0 ? -1 : 1;
  const int notches =
      static_cast<int>(input.wheel > 0 ? std::ceil(input.wheel) : std::floor(input.wheel));
  cross_[normal] = std::clamp(cross_[normal] + sign * notches, 0, frame.size[normal] - 1);
}

std::array<int, 3> Segmenting::voxel_of(const Vec3& voxel) const {
  std::array<int, 3> out{};
  for (std::size_t a = 0; a < 3; ++a) {
    const double v = std::clamp(voxel[static_cast<Eigen::Index>(a)], -1e6, 1e6);
    out[a] = static_cast<int>(std::floor(v + 0.5));
  }
  return out;
}

std::uint16_t Segmenting::label_at(const Vec3& voxel) const {
  const auto v = voxel_of(voxel);
  return edit_.labels().frame.contains(v[0], v[1], v[2]) ? edit_.labels().at(v[0], v[1], v[2])
                                                         : std::uint16_t{0};
}

void Segmenting::put_cross(const Vec3& voxel) {
  const auto v = voxel_of(voxel);
  for (std::size_t a = 0; a < 3; ++a)
    cross_[a] = std::clamp(v[a], 0, edit_.labels().frame.size[a] - 1);
}

// So that a bone chosen in the list is seen.
void Segmenting::go_to(std::uint16_t label) {
  const EditedLabel& bone = edit_.bones().at(label);
  if (bone.voxels == 0) return;
  for (std::size_t a = 0; a < 3; ++a) cross_[a] = (bone.box.lo[a] + bone.box.hi[a] - 1) / 2;
}

void Segmenting::choose(std::uint16_t label) {
  if (chosen_ == label) return;
  chosen_ = label;
  ++look_version_;
}

void Segmenting::keep_choice() {
  if (chosen_ != 0 && !edit_.has(chosen_)) choose(0);
}

LabelBrush Segmenting::brush(const PaneInput& input, bool erase) const {
  LabelBrush brush;
  brush.radius_m = tools_.radius_m;
  brush.slice_axis = tools_.ball ? -1 : planes_[input.pane].normal;
  brush.erase = erase;
  brush.over_others = tools_.over_others;
  if (tools_.within) brush.within = tools_.range;
  return brush;
}

Result<void> Segmenting::press(const PaneInput& input, const Vec3& voxel,
                               const Progress& progress) {
  switch (tools_.tool) {
    case SegmentTool::kCross:
      put_cross(voxel);
      if (const std::uint16_t label = label_at(voxel)) choose(label);
      return {};
    case SegmentTool::kPaint:
      return begin_paint(input, voxel, input.ctrl);
    case SegmentTool::kErase:
      return begin_paint(input, voxel, true);
    case SegmentTool::kGrow:
      return grow_at(voxel, tools_.fresh != input.shift, progress);
    case SegmentTool::kSplit:
      split_ = Stroke{input.pane, voxel, voxel};
      return {};
    case SegmentTool::kMerge:
      break;
  }
  return merge_at(voxel);
}

void Segmenting::drag(const PaneInput& input, const Vec3& voxel) {
  if (tools_.tool == SegmentTool::kCross) put_cross(voxel);
  if (painted_to_) {
    dab_label(edit_, chosen_, *painted_to_, voxel, brush(input, erasing_));
    painted_to_ = voxel;
  }
  if (split_ && split_->pane == input.pane) split_->to_voxel = voxel;
}

Result<void> Segmenting::release(const Progress& progress) {
  if (painted_to_) {
    painted_to_.reset();
    edit_.commit_step();
  }
  return split_ ? end_split(progress) : Result<void>();
}

Result<void> Segmenting::begin_paint(const PaneInput& input, const Vec3& voxel, bool erase) {
  if (erase && chosen_ == 0) {
    choose(label_at(voxel));
    if (chosen_ == 0) return fail("no bone is chosen", {}, "Click on the one to erase from");
  }
  edit_.begin_step(erase ? "Erase" : "Paint");
  if (chosen_ == 0) {
    const auto made = edit_.add();
    if (!made) {
      edit_.cancel_step();
      return tl::unexpected(made.error());
    }
    choose(*made);
  }
  erasing_ = erase;
  painted_to_ = voxel;
  dab_label(edit_, chosen_, voxel, voxel, brush(input, erase));
  return {};
}

Result<void> Segmenting::grow_at(const Vec3& voxel, bool fresh, const Progress& progress) {
  const std::uint16_t there = label_at(voxel);
  if (fresh && there != 0) {
    choose(there);
    return {};
  }
  GrowOptions options;
  options.range = tools_.range;
  options.reach_m = tools_.reach_m;
  options.fill = tools_.fill;
  const auto grown = fresh || chosen_ == 0
                         ? grow_new_label(edit_, voxel_of(voxel), options, progress)
                         : grow_label(edit_, chosen_, voxel_of(voxel), options, progress);
  if (!grown) return tl::unexpected(grown.error());
  if (const std::uint16_t label = label_at(voxel)) choose(label);
  return {};
}

Result<void> Segmenting::merge_at(const Vec3& voxel) {
  const std::uint16_t there = label_at(voxel);
  if (there == 0) return fail("there is no bone at this place", {}, "Click on a coloured one");
  if (chosen_ == 0) {
    choose(there);
    return {};
  }
  return edit_.merge(there, chosen_);
}

Result<void> Segmenting::end_split(const Progress& progress) {
  const Stroke stroke = *std::exchange(split_, std::nullopt);
  const auto from = voxel_of(stroke.from_voxel), to = voxel_of(stroke.to_voxel);
  const std::uint16_t label = label_at(stroke.from_voxel);
  if (from == to) {
    if (label == 0) return fail("there is no bone at this place", {}, "Click on a coloured one");
    const auto made = split_label(edit_, label, progress);
    return made ? Result<void>() : tl::unexpected(made.error());
  }
  const auto made = split_label_between(edit_, from, to, progress);
  if (!made) return tl::unexpected(made.error());
  choose(*made);
  return {};
}

}  // namespace osteon
