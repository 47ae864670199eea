#include "window/window_app.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <cmath>
#include <ctime>

#include "cases/xdg.h"
#include "loops/realtime.h"
#include "loops/stop_signal.h"
#include "osteon/base/clock.h"
#include "osteon/base/file.h"
#include "runs/hand_order.h"
#include "runs/path_commands.h"
#include "ui/screenshot.h"

namespace osteon {
namespace {

// A display without a refresh to wait for would otherwise take all the processor.
constexpr std::int64_t kShortestFrame_ns = 1'000'000'000 / 60;
constexpr std::int64_t kShortestFrameOnDisplay_ns = 1'000'000'000 / 250;

double processor_now_s() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

double seconds(std::int64_t ns) { return static_cast<double>(ns) * 1e-9; }

// What hands are told to hold, and what the path that an emulated one plays takes.
std::vector<std::string> ordered_instruments(const WindowOrder& order) {
  std::vector<std::string> names;
  for (const std::string& device : order.devices)
    names.push_back(parse_hand_order(device).instrument);
  const auto path = order.path.empty() ? Result<ProbePath>(ProbePath{}) : load_path(order.path);
  if (path && path->with_instruments)
    for (const std::string& name : instruments_of(*path)) names.push_back(name);
  return names;
}

}  // namespace

WindowApp::WindowApp(const WindowOrder& order)
    : order_(order),
      created_ns_(steady_now_ns()),
      layout_(order.layout),
      observer_layout_(order.observer.value_or(PictureLayout::kScope)) {}

Result<std::unique_ptr<WindowApp>> WindowApp::create(const WindowOrder& order) {
  std::unique_ptr<WindowApp> app(new WindowApp(order));
  std::string complaint;
  if (!order.fresh) app->settings_ = load_app_settings(config_dir() / "settings.json", &complaint);
  WindowOptions options;
  options.width = order.width > 0 ? order.width : app->settings_.window_width;
  options.height = order.height > 0 ? order.height : app->settings_.window_height;
  options.wait_for_display = order.frames == 0;
  auto window = GlWindow::create(options);
  if (!window) return tl::unexpected(window.error());
  app->window_ = std::move(*window);
  app->ui_ = std::make_unique<ImGuiHost>(app->window_->handle(), 1.0f);
  // A measured run gives the same picture wherever the pointer lies.
  if (order.frames > 0) app->ui_->take_pointer(true);

  std::vector<std::string> problems;
  app->choices_ = list_device_choices(&problems);
  if (!complaint.empty()) app->note(ToastKind::kWarning, complaint);
  for (const std::string& problem : problems) app->note(ToastKind::kWarning, problem);
  app->instruments_ = ordered_instruments(order);
  if (order.observer) app->open_observer();
  app->open({order.case_spec, order.replay, nullptr});
  return app;
}

WindowApp::~WindowApp() {
  if (window_ && !order_.fresh) remember();
}

Result<void> WindowApp::run() {
  std::int64_t last_ns = steady_now_ns();
  const std::int64_t start_ns = last_ns;
  while (!window_->should_close() && !stop_requested()) {
    const std::int64_t begin_ns = steady_now_ns();
    const double dt_s = seconds(begin_ns - last_ns);
    last_ns = begin_ns;
    now_s_ = seconds(begin_ns - start_ns);
    frames_.add(dt_s);
    frame(dt_s);
    if (measured_run_over()) return finish_measured_run();
    window_->swap();
    if (first_picture_s_ <= 0 && ready()) first_picture_s_ = seconds(steady_now_ns() - created_ns_);
    if (measured_frames_ > 0) work_.add(seconds(steady_now_ns() - begin_ns));
    const bool paced = order_.frames == 0 && !software_driver();
    sleep_until_ns(begin_ns + (paced ? kShortestFrameOnDisplay_ns : kShortestFrame_ns));
  }
  checkup_.reset();
  film_.reset();
  return live_ ? live_->end() : Result<void>();
}

void WindowApp::frame(double dt_s) {
  window_->poll();
  const double wheel = static_cast<double>(ImGui::GetIO().MouseWheel);
  const double scale = order_.interface_scale > 0
                           ? order_.interface_scale
                           : static_cast<double>(window_->content_scale()) /
                                 window_->pixel_ratio() * settings_.interface_zoom;
  ui_->set_scale(static_cast<float>(scale));
  for (const std::string& file : window_->take_dropped_files()) open_any(file);
  poll_loading();
  poll_refining();
  poll_felt();
  poll_checkup();
  poll_edit_save();
  poll_patient();
  if (ready() || exercise_.page() == ExercisePage::kJudging) poll_exercise();
  poll_observer();
  toasts_.age(now_s_);

  ui_->begin_frame(window_->take_pressed_keys());
  if (ready()) poll_scene(dt_s, wheel);
  show_edit();
  draw_picture();
  // A processor that draws works on the picture while the panels are laid out.
  glFlush();
  const UiRequests requests = draw_ui(build_model(), ui_->fonts());
  ui_->end_frame();
  poll_film();
  draw_observer();
  apply(requests);
}

void WindowApp::draw_picture() {
  int width = 0, height = 0;
  window_->framebuffer_size(width, height);
  glBindFramebuffer(GL_FRAMEBUFFER, 0);
  glViewport(0, 0, width, height);
  glClearColor(0x15 / 255.0f, 0x18 / 255.0f, 0x1c / 255.0f, 1);
  glClear(GL_COLOR_BUFFER_BIT);
  // What was open stays in sight until the next is.
  if (!renderer_ || !case_ || width <= 0 || height <= 0) return;
  ViewState shown = picture_view();
  for (const BoneId id : {hovered_, hovered_row_, picked_})
    if (id.index < shown.bones.size()) shown.bones[id.index].highlighted = true;
  show_others();
  show_carved();
  update_views();
  draw_panes(shown);
}

// Counts pictures once the simulated time that was ordered is reached.
bool WindowApp::measured_run_over() {
  if (order_.frames <= 0) return false;
  if (!load_failure_.empty()) return true;
  // A replay stands at the ordered moment from the start.
  const bool reached = player_ || shown_.tool.time_s >= order_.at_s;
  if (!ready() || !reached || checkup_ || felt_job_ || refining_ || lighting_ || views_.busy() ||
      first_pictures_ > 0) {
    if (ready() && first_pictures_ > 0) --first_pictures_;
    processor_start_s_ = processor_now_s();
    return false;
  }
  return ++measured_frames_ >= order_.frames;
}

double WindowApp::processor_ms_per_picture() const {
  return 1e3 * (processor_now_s() - processor_start_s_) / std::max(1, measured_frames_);
}

Result<void> WindowApp::finish_measured_run() {
  if (film_) {
    film_->end(now_s_ - film_from_s_);
    if (auto whole = film_->wait(); !whole) return whole;
  }
  if (!load_failure_.empty()) return fail(load_failure_);
  if (order_.screenshot.empty()) return {};
  int width = 0, height = 0;
  window_->framebuffer_size(width, height);
  return save_png(read_framebuffer(width, height), order_.screenshot);
}

}  // namespace osteon
