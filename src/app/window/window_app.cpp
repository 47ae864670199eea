#include "window/window_app.h"

#include <epoxy/gl.h>
#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <algorithm>
#include <ctime>
#include <functional>
#include <numbers>
#include <utility>

#include "cases/xdg.h"
#include "loops/realtime.h"
#include "loops/stop_signal.h"
#include "osteon/base/log.h"
#include "ui/screenshot.h"
#include "window/controllers/cases/remembered_looks.h"
#include "window/panels/panels.h"

namespace osteon {
namespace {

// A display without a refresh to wait for would otherwise take all the processor.
constexpr std::int64_t kShortestFrame_ns = 1'000'000'000 / 60;
constexpr std::int64_t kShortestFrameOnDisplay_ns = 1'000'000'000 / 250;
// Growing bones, or an expert who plays what comes before, needs the processor more than the bar
// that shows how far it is: where the processor draws, an expert beside a picture that is drawn at
// full rate takes several times as long.
constexpr std::int64_t kShortestWait_ns = 1'000'000'000 / 15;

double processor_now_s() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

double seconds(std::int64_t ns) { return static_cast<double>(ns) * 1e-9; }

}  // namespace

Result<std::unique_ptr<WindowApp>> WindowApp::create(const WindowOrder& order) {
  std::unique_ptr<WindowApp> app(new WindowApp(order));
  WindowHost& host = app->host_;
  std::string complaint;
  if (!order.fresh) host.settings = load_app_settings(config_dir() / "settings.json", &complaint);
  WindowOptions options;
  options.width = order.width > 0 ? order.width : host.settings.window_width;
  options.height = order.height > 0 ? order.height : host.settings.window_height;
  options.within_screen = order.width == 0 && !order.fresh;
  options.wait_for_display = order.frames == 0;
  auto window = GlWindow::create(options);
  if (!window) return tl::unexpected(window.error());
  host.window = std::move(*window);
  host.ui = std::make_unique<ImGuiHost>(host.window->handle(), 1.0f);
  // A measured run gives the same picture wherever the pointer lies.
  if (order.frames > 0) host.ui->take_pointer(true);
  if (!complaint.empty()) host.note(ToastKind::kWarning, complaint);
  app->live_.list_devices();
  if (order.observer) app->observer_.open();
  app->cases_.open({order.case_spec, order.replay, nullptr});
  return app;
}

WindowApp::~WindowApp() {
  if (host_.window && !host_.order.fresh) remember();
}

Result<void> WindowApp::run() {
  std::int64_t last_ns = steady_now_ns();
  const std::int64_t start_ns = last_ns;
  while (!host_.window->should_close() && !stop_requested()) {
    const std::int64_t begin_ns = steady_now_ns();
    const double dt_s = seconds(begin_ns - last_ns);
    last_ns = begin_ns;
    host_.now_s = seconds(begin_ns - start_ns);
    frames_.add(dt_s);
    frame(dt_s);
    if (measured_run_over()) return finish_measured_run();
    host_.window->swap();
    if (first_picture_s_ <= 0 && cases_.ready()) first_picture_s_ = host_.age_s();
    const double work_s = seconds(steady_now_ns() - begin_ns);
    if (measured_frames_ > 0) work_.add(work_s);
    views_.picture_took(work_s);
    const bool paced = host_.order.frames == 0 && !software_driver();
    const std::int64_t shortest_ns = paced ? kShortestFrameOnDisplay_ns : kShortestFrame_ns;
    const bool waits = (!scene_.renderer && cases_.loading()) || exercise_.beginning();
    sleep_until_ns(begin_ns + (waits ? kShortestWait_ns : shortest_ns));
  }
  checkup_.drop();
  film_.drop();
  sound_.drop();
  return live_.end();
}

void WindowApp::frame(double dt_s) {
  GlWindow& window = *host_.window;
  window.poll();
  const double wheel = static_cast<double>(ImGui::GetIO().MouseWheel);
  const double scale = host_.order.interface_scale > 0
                           ? host_.order.interface_scale
                           : static_cast<double>(window.content_scale()) / window.pixel_ratio() *
                                 host_.settings.interface_zoom;
  host_.ui->set_scale(static_cast<float>(scale));
  poll_jobs();
  host_.toasts.age(host_.now_s);

  host_.ui->begin_frame(window.take_pressed_keys());
  if (cases_.ready()) move_scene(dt_s, wheel);
  edit_.show();
  draw_picture();
  // A processor that draws works on the picture while the panels are laid out.
  glFlush();
  const UiRequests requests = draw_ui(build_model(), host_.ui->fonts());
  host_.ui->end_frame();
  make_sound();
  film_.poll();
  observer_.draw(picture_view());
  apply(requests);
}

void WindowApp::poll_jobs() {
  browser_.open_together(host_.window->take_dropped_files());
  poll_loading();
  // A piece lies within its bone's hull: who touches no hull touches no piece, and feels nothing of
  // the exchange.
  const bool at_rest = cases_.ready() && !replay_.on() && !edit_.on() && !checkup_.running() &&
                       !bend_.on() &&
                       (!live_.run() || (!live_.recording() && live_.run()->touches_nothing()));
  if (cases_.poll_finer(at_rest)) {
    edit_.draw_again();
    views_.draw_softs_again();
  }
  checkup_.poll();
  edit_.poll_save();
  notes_.poll_save();
  patient_.poll();
  exercise_.poll();
  UiRequests off;
  off.force_off = true;
  if (observer_.poll()) live_.apply_feel(off, false);
}

void WindowApp::poll_loading() {
  std::optional<Loaded> loaded;
  if (!cases_.poll(loaded)) return;
  if (loaded) install(std::move(*loaded));
  bend_.end();
  if (loaded) begin_ordered();
}

void WindowApp::install(Loaded loaded) {
  checkup_.end();
  edit_.end();
  if (scene_.the_case) {
    remember_looks(host_.settings, scene_.source, *scene_.the_case, sight_.view());
    remember_light(host_.settings, sight_.view());  // one that was turned is not turned back
  }
  const auto before = scene_.the_case;
  if (!cases_.show(loaded)) return;
  if (scene_.the_case != before) {
    hands_.begin_case();
    notes_.begin_case();
  }
  hands_.begin_run();
  marks_.clear();
  if (loaded.replay) return replay_.begin(std::move(*loaded.replay));
  if (exercise_.opening()) return exercise_.begin();
  live_.begin();
  if (!live_.run() || host_.order.edit.empty()) return;
  sight_.pick(scene_.the_case->find(std::exchange(host_.order.edit, {})));
  edit_.begin();
}

// What the command line asks for beside the case.
void WindowApp::begin_ordered() {
  WindowOrder& order = host_.order;
  if (!order.film.empty()) film_.begin(std::exchange(order.film, {}));
  if (std::exchange(order.new_patient, false)) patient_.toggle();
  if (!order.exercise.empty()) exercise_.show(std::exchange(order.exercise, {}));
  if (std::exchange(order.checkup, false)) checkup_.open();
}

void WindowApp::move_scene(double dt_s, double wheel) {
  // Who was still pushing an instrument as the attempt ended does not zoom.
  pointer_.poll(dt_s, exercise_.judging() ? 0 : wheel);
  replay_.advance(dt_s);
  bend_.show();
  pointer_.pick();
  if (measured_frames_ > 0 && host_.order.turn_deg != 0) {
    Camera& camera = sight_.view().camera;
    camera = orbit(camera, Vec3::UnitZ(), host_.order.turn_deg * std::numbers::pi / 180, 0);
  }
}

ViewState WindowApp::picture_view() const {
  ViewState view = sight_.view();
  view.show_felt = view.show_felt && cases_.felt_known();
  bend_.hide_softs(view);
  return view;
}

void WindowApp::make_sound() {
  SoundControl::Scene scene;
  if (const LoadedReplay* const replay = replay_.replay())
    scene = {{0, std::hash<std::string>()(replay->file.string())},
             &replay->instruments,
             &replay->events,
             true};
  else if (LiveRun* const run = live_.run())
    scene = {{live_.runs_made(), run->run_number()}, &run->tray().names, &run->events(), false};
  sound_.update(scene, views_.moment());
}

void WindowApp::draw_picture() {
  const auto size = host_.pixels();
  glBindFramebuffer(GL_FRAMEBUFFER, 0);
  glViewport(0, 0, size.width, size.height);
  glClearColor(0x15 / 255.0f, 0x18 / 255.0f, 0x1c / 255.0f, 1);
  glClear(GL_COLOR_BUFFER_BIT);
  // What was open stays in sight until the next is.
  if (!scene_.renderer || !scene_.the_case || size.width <= 0 || size.height <= 0) return;
  ViewState shown = picture_view();
  sight_.highlight(shown);
  views_.draw(shown);
}

void WindowApp::remember() {
  GLFWwindow* const window = host_.window->handle();
  AppSettings& settings = host_.settings;
  if (!glfwGetWindowMonitor(window))
    glfwGetWindowSize(window, &settings.window_width, &settings.window_height);
  if (scene_.the_case) {
    remember_light(settings, sight_.view());
    remember_looks(settings, scene_.source, *scene_.the_case, sight_.view());
  }
  live_.remember_feel();
  const Result<void> saved = save_app_settings(settings, config_dir() / "settings.json");
  if (!saved) log(LogLevel::kWarning, saved.error().message());
}

// Counts pictures once the simulated time that was ordered is reached.
bool WindowApp::measured_run_over() {
  const WindowOrder& order = host_.order;
  if (order.frames <= 0) return false;
  if (!cases_.failure().empty()) return true;
  // A replay stands at the ordered moment from the start.
  const bool reached = replay_.on() || sight_.shown().tool.time_s >= order.at_s;
  if (!cases_.ready() || !reached || checkup_.running() || cases_.busy() || scene_.views.busy() ||
      first_pictures_ > 0) {
    if (cases_.ready() && first_pictures_ > 0) --first_pictures_;
    processor_start_s_ = processor_now_s();
    return false;
  }
  return ++measured_frames_ >= order.frames;
}

double WindowApp::processor_ms_per_picture() const {
  return 1e3 * (processor_now_s() - processor_start_s_) / std::max(1, measured_frames_);
}

Result<void> WindowApp::finish_measured_run() {
  if (auto whole = film_.finish(); !whole) return whole;
  if (!cases_.failure().empty()) return fail(cases_.failure());
  if (host_.order.screenshot.empty()) return {};
  const auto size = host_.pixels();
  return save_png(read_framebuffer(size.width, size.height), host_.order.screenshot);
}

}  // namespace osteon
