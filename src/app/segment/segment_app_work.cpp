// What the segmentation window does beside the picture: opening, finding, heavy changes, saving.
#include <algorithm>
#include <system_error>
#include <utility>

#include "cases/label_case.h"
#include "cases/whole_folder.h"
#include "cases/xdg.h"
#include "segment/segment_app.h"

namespace osteon {

// Whoever named the scan on the command line wanted this one or none.
void SegmentApp::cancel_opening() {
  if (chosen_in_window_)
    choose_scan(order_.scan.source);
  else
    ends_ = true;
}

void SegmentApp::choose_scan(const std::filesystem::path& near) {
  std::error_code ec;
  failure_.clear();
  if (!chooser_) chooser_.emplace();
  const bool folder = std::filesystem::is_directory(near, ec);
  chooser_->folder = list_scan_folder(folder ? near : near.parent_path());
}

void SegmentApp::apply_chooser(const SegmentRequests& requests) {
  if (requests.choose_scan) choose_scan(order_.scan.source);
  if (!chooser_) return;
  if (requests.series) chooser_->series = *requests.series;
  if (requests.spacing_mm) chooser_->spacing_mm = *requests.spacing_mm;
  std::error_code ec;
  if (requests.browse && std::filesystem::is_regular_file(*requests.browse, ec))
    return open_chosen(*requests.browse);
  if (requests.browse) chooser_->folder = list_scan_folder(*requests.browse);
  if (requests.open_scan) open_chosen(*requests.open_scan);
}

void SegmentApp::ask_desktop(const SegmentRequests& requests) {
  if (!chooser_) return;
  desktop_.look_for();
  if (requests.desktop_file || requests.desktop_folder)
    desktop_.ask(
        {"Choose a scan to segment", requests.desktop_folder, window_->name_for_desktop()});
  const Result<std::vector<std::string>> chosen = desktop_.take();
  if (!chosen) return note(ToastKind::kError, chosen.error().message());
  open_together(*chosen);
  if (!chooser_) return;
  chooser_->desktop_files = desktop_.offers_files();
  chooser_->desktop_folders = desktop_.offers_folders();
  chooser_->desktop_asks = desktop_.asks();
}

// What was dropped on the window or chosen in the desktop's chooser. A folder is shown first:
// pictures in it need the size of a voxel.
void SegmentApp::open_together(const std::vector<std::string>& paths) {
  if (paths.empty()) return;
  if (segmenting_ || opening_)
    return note(ToastKind::kWarning, "One scan is open here. Close this window before another one");
  const auto scan = scan_among(paths);
  if (!scan) return note(ToastKind::kWarning, scan.error().message());
  if (!chooser_) choose_scan(*scan);
  SegmentRequests requests;
  requests.browse = scan->string();
  apply_chooser(requests);
}

void SegmentApp::open_chosen(const std::filesystem::path& source) {
  order_.scan.source = plain_folder(source);
  order_.scan.series = chooser_->series;
  order_.scan.spacing_m.reset();
  if (chooser_->folder.pictures > 0) order_.scan.spacing_m = chooser_->spacing_mm / 1000;
  if (!out_given_) order_.out.clear();
  chosen_in_window_ = true;
  chooser_.reset();
  begin_opening();
}

void SegmentApp::begin_opening() {
  if (order_.out.empty()) {
    const std::string stem = order_.scan.source.stem().string();
    order_.out = dated_file(data_home_dir() / "cases", stem.empty() ? "scan" : stem, "");
  }
  opening_ = std::make_unique<SideJob<OpenedScan>>(
      [scan = order_.scan](const Progress& progress) { return open_scan(scan, progress); });
}

void SegmentApp::poll_opening() {
  if (!opening_ || !opening_->done()) return;
  const bool cancelled = opening_->cancelled();
  auto opened = opening_->take();
  opening_.reset();
  if (cancelled) return cancel_opening();
  if (!opened) {
    failure_ = opened.error().message();
    return;
  }
  const auto& values = opened->edit.volume().values;
  const auto ends = std::minmax_element(values.begin(), values.end());
  values_ = {*ends.first, std::max<int>(*ends.second, *ends.first + 1)};
  segmenting_.emplace(std::move(opened->edit), opened->levels);
  X_WP_ = lying_pose_WP(segmenting_->edit().labels().frame);
  auto solid = SolidView::create(segmenting_->edit().labels().frame);
  if (solid)
    solid_ = std::move(*solid);
  else
    note(ToastKind::kWarning, solid.error().message());
  if (std::exchange(order_.suggest, false)) begin_suggestion();
}

void SegmentApp::begin_heavy(const SegmentRequests& requests) {
  heavy_since_s_ = now_s_;
  heavy_ = std::make_unique<SideJob<bool>>(
      [&segmenting = *segmenting_, requests](const Progress& progress) -> Result<bool> {
        if (auto done = segmenting.apply(requests, progress); !done)
          return tl::unexpected(done.error());
        return true;
      });
}

void SegmentApp::poll_heavy() {
  if (!heavy_ || !heavy_->done()) return;
  const bool cancelled = heavy_->cancelled();
  const auto done = heavy_->take();
  heavy_.reset();
  if (!done && !cancelled) note(ToastKind::kWarning, done.error().message());
}

void SegmentApp::begin_suggestion() {
  if (!segmenting_ || at_work()) return;
  suggesting_ = std::make_unique<SideJob<SuggestedLabels>>(
      [volume = segmenting_->edit().shared_volume(), levels = segmenting_->levels()](
          const Progress& progress) { return suggest_labels(*volume, levels, progress); });
}

void SegmentApp::poll_suggestion() {
  if (heavy_ || !suggesting_ || !suggesting_->done()) return;
  const bool cancelled = suggesting_->cancelled();
  auto found = suggesting_->take();
  suggesting_.reset();
  if (!found) {
    if (!cancelled) note(ToastKind::kError, found.error().message());
    return;
  }
  if (auto taken = segmenting_->take_labels(found->labels, found->names); !taken)
    return note(ToastKind::kError, taken.error().message());
  X_WP_ = found->X_WP;
  side_ = found->side;
  std::string told = side_.empty() ? std::to_string(found->names.size()) + " bones found"
                                   : "Recognised a " + side_ + " wrist";
  if (found->outside > 0) told += ". What lies outside the body, such as a head rest, is no bone";
  note(ToastKind::kInfo, told);
  for (const auto& [label, name] : found->names)
    if (name == order_.choose) choose(label);
}

void SegmentApp::choose(std::uint16_t label) {
  SegmentRequests requests;
  requests.choose = label;
  (void)segmenting_->apply(requests);
}

void SegmentApp::begin_saving() {
  if (!segmenting_ || at_work()) return;
  const LabelEdit& edit = segmenting_->edit();
  if (edit.in_step()) return;
  auto order = std::make_shared<SegmentSaveOrder>();
  order->volume = edit.shared_volume();
  order->labels = edit.labels();
  for (const auto& [label, bone] : edit.bones()) order->names[label] = bone.name;
  order->levels = segmenting_->levels();
  order->X_WP = X_WP_;
  order->side = side_;
  order->out = order_.out;
  order->replace = saved_before_;
  saving_version_ = edit.version();
  saving_ = std::make_unique<SideJob<SavedSegments>>(
      [order](const Progress& progress) { return save_segments(*order, progress); });
}

void SegmentApp::poll_saving() {
  if (heavy_ || !saving_ || !saving_->done()) return;
  const bool cancelled = saving_->cancelled();
  const auto saved = saving_->take();
  saving_.reset();
  const bool ends = std::exchange(ends_when_saved_, false);
  if (!saved) {
    if (!cancelled) note(ToastKind::kError, saved.error().message());
    return;
  }
  saved_before_ = true;
  // What was drawn while it was being saved is not in it.
  if (segmenting_->edit().version() == saving_version_) segmenting_->mark_saved();
  ends_ = ends;
  std::string text = std::to_string(saved->bones) + " bones saved as " + saved->folder.string();
  if (saved->without_voxels > 0)
    text += "; left out because they have no voxels: " + std::to_string(saved->without_voxels);
  note(saved->open_surfaces > 0 ? ToastKind::kWarning : ToastKind::kInfo,
       saved->open_surfaces > 0
           ? text + "; surfaces with holes: " + std::to_string(saved->open_surfaces)
           : text);
}

bool SegmentApp::at_work() const { return opening_ || suggesting_ || saving_ || heavy_; }

}  // namespace osteon
