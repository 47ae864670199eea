#include "segment/segmenting.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "osteon/scene/build_case.h"
#include "segment/label_color.h"

namespace osteon {

Segmenting::Segmenting(LabelEdit edit, const BoneLevels& levels)
    : edit_(std::move(edit)), levels_(levels), planes_(slice_planes(edit_.labels().frame)) {
  tools_.range.lo = static_cast<int>(std::lround(levels.threshold_hu));
  for (std::size_t a = 0; a < 3; ++a) cross_[a] = edit_.labels().frame.size[a] / 2;
}

SliceLook Segmenting::look() const {
  SliceLook look;
  look.grey = grey_;
  if (tools_.preview) look.preview = tools_.range;
  for (const auto& [label, bone] : edit_.bones())
    if (is_shown(label)) look.colors[label] = label_color(label);
  look.chosen = chosen_;
  return look;
}

void Segmenting::resize_pane(std::size_t pane, int width, int height) {
  SliceWindow& window = windows_[pane];
  if (window.width == width && window.height == height) return;
  const bool first = window.width <= 1;
  if (first) window = whole_slice(planes_[pane], edit_.labels().frame, width, height);
  window.width = width;
  window.height = height;
  ++look_version_;
}

Result<void> Segmenting::apply(const SegmentRequests& requests, const Progress& progress) {
  if (requests.tools && !(*requests.tools == tools_)) {
    tools_ = *requests.tools;
    ++look_version_;
  }
  if (requests.grey) {
    grey_ = *requests.grey;
    ++look_version_;
  }
  if (requests.fit_panes)
    for (std::size_t p = 0; p < 3; ++p) {
      windows_[p] =
          whole_slice(planes_[p], edit_.labels().frame, windows_[p].width, windows_[p].height);
      ++look_version_;
    }
  apply_history(requests);
  Result<void> outcome = apply_bones(requests, progress);
  if (outcome && requests.pointer) outcome = point(*requests.pointer, progress);
  keep_choice();
  return outcome;
}

void Segmenting::apply_history(const SegmentRequests& requests) {
  if (!requests.undo && !requests.redo) return;
  split_.reset();
  // In the middle of a stroke, that stroke is what is undone.
  const bool painting = painted_to_.has_value();
  painted_to_.reset();
  if (painting)
    edit_.cancel_step();
  else
    requests.undo ? edit_.undo() : edit_.redo();
}

Result<void> Segmenting::apply_bones(const SegmentRequests& requests, const Progress& progress) {
  if (requests.choose && edit_.has(*requests.choose)) {
    choose(*requests.choose);
    go_to(*requests.choose);
  }
  if (requests.show_all) hidden_.clear(), ++look_version_;
  if (requests.hide_others) {
    for (const auto& [label, bone] : edit_.bones())
      if (label != chosen_) hidden_.insert(label);
    hidden_.erase(chosen_);
    ++look_version_;
  }
  if (requests.toggle_shown) {
    if (!hidden_.erase(*requests.toggle_shown)) hidden_.insert(*requests.toggle_shown);
    ++look_version_;
  }
  if (requests.rename)
    return edit_.rename(requests.rename->label, canonical_bone_name(requests.rename->name));
  if (requests.remove) return edit_.remove(*requests.remove);
  if (requests.merge) return edit_.merge(*requests.merge, chosen_);
  if (requests.find_bodies) return find_bodies(progress);
  if (requests.split_chosen) {
    const auto made = split_label(edit_, chosen_, progress);
    if (!made) return tl::unexpected(made.error());
  }
  if (requests.add) {
    const auto made = edit_.add();
    if (!made) return tl::unexpected(made.error());
    choose(*made);
  }
  return {};
}

Result<void> Segmenting::find_bodies(const Progress& progress) {
  BodyOptions options;
  options.range = tools_.range;
  options.fill = tools_.fill;
  const auto made = label_bodies(edit_, options, progress);
  if (!made) return tl::unexpected(made.error());
  choose(made->front());
  return {};
}

Result<void> Segmenting::take_labels(const LabelVolume& labels,
                                     const std::map<std::uint16_t, std::string>& names) {
  painted_to_.reset();
  split_.reset();
  auto taken = edit_.replace(labels, names, "Find the bones");
  keep_choice();
  return taken;
}

}  // namespace osteon
