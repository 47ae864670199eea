#include "segment/segment_app.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <system_error>
#include <utility>

#include "cases/whole_folder.h"
#include "cases/xdg.h"
#include "loops/realtime.h"
#include "loops/stop_signal.h"
#include "osteon/base/clock.h"
#include "ui/screenshot.h"

namespace osteon {
namespace fs = std::filesystem;
namespace {

constexpr std::int64_t kShortestFrame_ns = 1'000'000'000 / 60;
constexpr double kWaitShown_s = 0.3;  // work that is done before is not told
constexpr std::size_t kManyVoxels = 2'000'000;

double seconds(std::int64_t ns) { return static_cast<double>(ns) * 1e-9; }

/// What may take seconds on a large scan.
bool is_heavy(const SegmentRequests& requests, const Segmenting& segmenting) {
  if (requests.find_bodies || requests.split_chosen) return true;
  const LabelEdit& edit = segmenting.edit();
  // In the middle of a stroke, that stroke is what is undone.
  if (!edit.in_step() && ((requests.undo && edit.undo_voxels() > kManyVoxels) ||
                          (requests.redo && edit.redo_voxels() > kManyVoxels)))
    return true;
  const SegmentTool tool = segmenting.tools().tool;
  if (!requests.pointer) return false;
  return (tool == SegmentTool::kGrow && requests.pointer->pressed) ||
         (tool == SegmentTool::kSplit && requests.pointer->released);
}

}  // namespace

SegmentApp::SegmentApp(const SegmentOrder& order) : order_(order) {}

Result<std::unique_ptr<SegmentApp>> SegmentApp::create(const SegmentOrder& order) {
  std::unique_ptr<SegmentApp> app(new SegmentApp(order));
  if (!order.fresh) app->settings_ = load_app_settings(config_dir() / "settings.json", nullptr);
  WindowOptions options;
  options.width = order.width > 0 ? order.width : app->settings_.window_width;
  options.height = order.height > 0 ? order.height : app->settings_.window_height;
  options.title = "Osteon segmentation";
  options.within_screen = order.width == 0 && !order.fresh;
  options.wait_for_display = order.frames == 0;
  auto window = GlWindow::create(options);
  if (!window) return tl::unexpected(window.error());
  app->window_ = std::move(*window);
  app->ui_ = std::make_unique<ImGuiHost>(app->window_->handle(), 1.0f);
  app->out_given_ = !order.out.empty();
  if (order.scan.source.empty()) {
    std::error_code ec;
    app->choose_scan(fs::current_path(ec));
  } else {
    app->order_.scan.source = plain_folder(order.scan.source);
    app->begin_opening();
  }
  return app;
}

Result<void> SegmentApp::run() {
  const std::int64_t start_ns = steady_now_ns();
  while (!wants_to_end()) {
    const std::int64_t begin_ns = steady_now_ns();
    now_s_ = seconds(begin_ns - start_ns);
    frame();
    if (measured_run_over()) return finish_measured_run();
    window_->swap();
    work_.add(seconds(steady_now_ns() - begin_ns));
    sleep_until_ns(begin_ns + kShortestFrame_ns);
  }
  return failure_.empty() ? Result<void>() : fail(failure_);
}

// What was drawn is asked about before it is lost; a signal ends at once.
bool SegmentApp::wants_to_end() {
  if (ends_ || stop_requested()) return true;
  if (heavy_ || !window_->should_close()) return false;
  if (!changed()) return true;
  window_->stay_open();
  asks_to_close_ = true;
  return false;
}

void SegmentApp::note(ToastKind kind, std::string text) {
  if (!text.empty()) text[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(text[0])));
  toasts_.add(kind, std::move(text), now_s_);
}

void SegmentApp::frame() {
  window_->poll();
  const double scale = order_.interface_scale > 0
                           ? order_.interface_scale
                           : static_cast<double>(window_->content_scale()) /
                                 window_->pixel_ratio() * settings_.interface_zoom;
  ui_->set_scale(static_cast<float>(scale));
  poll_heavy();
  poll_opening();
  poll_suggestion();
  poll_saving();
  toasts_.age(now_s_);
  ui_->begin_frame(window_->take_pressed_keys());
  const ImVec2 size = ImGui::GetIO().DisplaySize;
  const SegmentLayout layout = make_segment_layout(size.x, size.y, ui_->scale(), panels_open_);
  int width = 0, height = 0;
  window_->framebuffer_size(width, height);
  glBindFramebuffer(GL_FRAMEBUFFER, 0);
  glViewport(0, 0, width, height);
  glClearColor(0x15 / 255.0f, 0x18 / 255.0f, 0x1c / 255.0f, 1);
  glClear(GL_COLOR_BUFFER_BIT);
  if (segmenting_ && width > 0 && height > 0) {
    if (!heavy_) place_panes(layout);
    if (!heavy_) draw_panes();
    draw_solid(layout);
  }
  open_together(window_->take_dropped_files());
  const SegmentRequests requests = draw_segment_ui(shown_model(), ui_->fonts());
  ui_->end_frame();
  apply(requests, layout);
  tell_title();
}

// "wrist.nrrd* - Osteon segmentation": the star stands for what is not saved.
void SegmentApp::tell_title() {
  if (!segmenting_ || heavy_) return;
  const std::string title = order_.scan.source.filename().string() + (changed() ? "*" : "") +
                            (saving_ ? " (saving)" : "") + " - Osteon segmentation";
  if (title != title_) window_->set_title(title);
  title_ = title;
}

SegmentModel SegmentApp::shown_model() {
  if (!heavy_) return last_model_ = build_model();
  const ImVec2 size = ImGui::GetIO().DisplaySize;
  last_model_.width = size.x;
  last_model_.height = size.y;
  last_model_.toasts = toasts_.shown();
  last_model_.help_open = help_open_;
  last_model_.panels_open = panels_open_;
  last_model_.job.reset();
  if (now_s_ - heavy_since_s_ > kWaitShown_s) last_model_.job = job_model(heavy_->progress());
  return last_model_;
}

void SegmentApp::place_panes(const SegmentLayout& layout) {
  const double ratio = window_->pixel_ratio();
  for (std::size_t p = 0; p < layout.slices.size(); ++p)
    segmenting_->resize_pane(
        p, static_cast<int>(std::lround(static_cast<double>(layout.slices[p].w) * ratio)),
        static_cast<int>(std::lround(static_cast<double>(layout.slices[p].h) * ratio)));
}

// A pane is drawn anew only when what it shows has changed.
void SegmentApp::draw_panes() {
  const std::uint64_t look = segmenting_->look_version();
  for (std::size_t p = 0; p < textures_.size(); ++p) {
    const int slice = segmenting_->slice(p);
    if (drawn_[p].look == look && drawn_[p].slice == slice) continue;
    const SliceWindow& window = segmenting_->windows()[p];
    draw_slice(segmenting_->edit(), segmenting_->planes()[p], window, slice, segmenting_->look(),
               pixels_);
    textures_[p].set(window.width, window.height, pixels_);
    drawn_[p] = {look, slice};
  }
}

Viewport SegmentApp::viewport_of(const UiRect& rect) const {
  const double ratio = window_->pixel_ratio();
  int width = 0, height = 0;
  window_->framebuffer_size(width, height);
  const auto px = [ratio](float v) {
    return static_cast<int>(std::lround(static_cast<double>(v) * ratio));
  };
  return {px(rect.x), height - px(rect.bottom()), px(rect.w), px(rect.h)};
}

void SegmentApp::draw_solid(const SegmentLayout& layout) {
  if (!solid_) return;
  if (!heavy_) solid_->update(*segmenting_);
  solid_->draw(viewport_of(layout.solid));
}

SegmentRequests SegmentApp::in_pane_pixels(SegmentRequests requests) const {
  const double ratio = window_->pixel_ratio();
  if (requests.pointer)
    for (double* v :
         {&requests.pointer->x, &requests.pointer->y, &requests.pointer->dx, &requests.pointer->dy})
      *v *= ratio;
  for (double* v : {&requests.solid.x, &requests.solid.y, &requests.solid.dx, &requests.solid.dy})
    *v *= ratio;
  return requests;
}

void SegmentApp::apply(const SegmentRequests& asked, const SegmentLayout& layout) {
  const SegmentRequests requests = in_pane_pixels(asked);
  apply_window(requests);
  apply_closing(requests);
  apply_chooser(requests);
  ask_desktop(requests);
  if (!segmenting_ || heavy_) return;
  pointer_ = requests.pointer;
  if (is_heavy(requests, *segmenting_)) return begin_heavy(requests);
  if (auto done = segmenting_->apply(requests); !done)
    note(ToastKind::kWarning, done.error().message());
  if (const std::uint16_t label =
          solid_ ? solid_->steer(requests.solid, viewport_of(layout.solid)) : std::uint16_t{0})
    choose(label);
  if (requests.suggest) begin_suggestion();
  if (requests.save) begin_saving();
}

void SegmentApp::apply_window(const SegmentRequests& requests) {
  if (requests.toggle_help) help_open_ = !help_open_;
  if (requests.toggle_panels) panels_open_ = !panels_open_;
  if (requests.toggle_fullscreen) window_->toggle_fullscreen();
  if (requests.dismiss_toast) toasts_.dismiss(*requests.dismiss_toast);
  if (requests.zoom_interface)
    settings_.interface_zoom =
        std::clamp(settings_.interface_zoom * *requests.zoom_interface, 0.75, 2.5);
  if (!requests.cancel_job) return;
  if (opening_) opening_->cancel();
  if (suggesting_) suggesting_->cancel();
  if (saving_) saving_->cancel();
  if (heavy_) heavy_->cancel();
  ends_when_saved_ = false;
}

void SegmentApp::apply_closing(const SegmentRequests& requests) {
  if (requests.quit) window_->close();
  if (requests.stay) asks_to_close_ = false;
  if (requests.quit_without_saving) ends_ = true;
  if (requests.open_case && holds_saved_case()) {
    case_to_open_ = order_.out;
    ends_ = true;
  }
  if (!requests.quit_after_saving || heavy_) return;
  asks_to_close_ = false;
  begin_saving();
  ends_when_saved_ = saving_ != nullptr;
}

bool SegmentApp::holds_saved_case() const {
  return saved_before_ && !heavy_ && !at_work() && !changed();
}

bool SegmentApp::measured_run_over() {
  if (order_.frames <= 0) return false;
  if (!failure_.empty()) return true;
  if (chooser_) return ++measured_frames_ >= order_.frames;
  if (!segmenting_ || at_work() || (solid_ && solid_->busy())) {
    work_.clear();
    return false;
  }
  return ++measured_frames_ >= order_.frames;
}

Result<void> SegmentApp::finish_measured_run() {
  if (!failure_.empty()) return fail(failure_);
  if (order_.screenshot.empty()) return {};
  int width = 0, height = 0;
  window_->framebuffer_size(width, height);
  return save_png(read_framebuffer(width, height), order_.screenshot);
}

}  // namespace osteon
