// The second window for who looks on, and the film of the first.
#include <epoxy/gl.h>

#include <algorithm>

#include "cases/xdg.h"
#include "ui/screenshot.h"
#include "window/window_app.h"

namespace osteon {
namespace fs = std::filesystem;

namespace {

constexpr int kKeyEscape = 256, kKeyV = 'V';  // GLFW's numbers

}  // namespace

void WindowApp::open_observer() {
  bool own_screen = false;
  auto opened = ObserverWindow::open(*window_, own_screen);
  if (!opened) return note(ToastKind::kError, opened.error().message());
  observer_ = std::move(*opened);
  if (!own_screen)
    note(ToastKind::kInfo,
         "There is one screen only: the second window is an ordinary one. What it shows is chosen "
         "on the left under View, or by V within it.");
}

// The force goes off by Esc wherever the keyboard is.
void WindowApp::poll_observer() {
  if (!observer_) return;
  UiRequests off;
  off.force_off = true;
  for (const int key : observer_->take_pressed_keys()) {
    if (key == kKeyEscape) apply_run(off);
    if (key == kKeyV) observer_layout_ = next_layout(observer_layout_);
  }
  if (observer_->came_back())
    note(ToastKind::kWarning, "The second screen is gone: its window is on this one now.");
  if (observer_->closed()) observer_.reset();
}

// Panes of the observer's window, in its pixels.
std::vector<Pane> WindowApp::observer_panes() const {
  int width = 0, height = 0;
  observer_->size(width, height);
  return panes_of(observer_layout_, {0, 0, static_cast<float>(width), static_cast<float>(height)},
                  ui_->scale(), views_.has_shot());
}

int WindowApp::observer_scope_px() const {
  if (!observer_) return 0;
  float side = 0;
  for (const Pane& pane : observer_panes())
    if (pane.kind == PaneKind::kScope) side = std::min(pane.area.w, pane.area.h);
  return static_cast<int>(side);
}

void WindowApp::draw_observer() {
  if (!observer_ || !observer_->due(now_s_) || !renderer_ || !case_) return;
  int width = 0, height = 0;
  observer_->size(width, height);
  if (width <= 0 || height <= 0) return;
  observer_picture_.resize(width, height);
  glBindFramebuffer(GL_FRAMEBUFFER, observer_picture_.framebuffer());
  fill_viewport({0, 0, width, height}, 0, 0, 0);
  const ViewState looks = picture_view();
  for (const Pane& pane : observer_panes()) {
    const UiRect& r = pane.area;
    const Viewport at{static_cast<int>(r.x), height - static_cast<int>(r.bottom()),
                      static_cast<int>(r.w), static_cast<int>(r.h)};
    if (pane.kind == PaneKind::kOutside) views_.draw_outside(at, looks);
    if (pane.kind == PaneKind::kScope) views_.draw_scope(at, std::min(at.width, at.height));
    if (pane.kind == PaneKind::kPanorama) views_.draw_panorama(at, true);
    if (pane.kind == PaneKind::kFluoro) views_.draw_fluoro(at);
  }
  glBindFramebuffer(GL_FRAMEBUFFER, 0);
  observer_->show(observer_picture_, now_s_);
}

void WindowApp::begin_film(const fs::path& file) {
  int width = 0, height = 0;
  window_->framebuffer_size(width, height);
  auto film = ScreenFilm::begin(file, width, height);
  if (!film) return note(ToastKind::kError, film.error().message());
  film_ = std::move(*film);
  film_from_s_ = now_s_;
}

void WindowApp::toggle_film() {
  if (film_) return film_->end(now_s_ - film_from_s_);
  const fs::path folder = data_home_dir() / "films";
  std::error_code ec;
  fs::create_directories(folder, ec);
  begin_film(dated_file(folder, "osteon", ".webm"));
}

// After all of the window is drawn.
void WindowApp::poll_film() {
  if (!film_) return;
  const double time_s = now_s_ - film_from_s_;
  if (film_->due(time_s)) {
    int width = 0, height = 0;
    window_->framebuffer_size(width, height);
    if (width > 0 && height > 0) film_->add(time_s, read_framebuffer(width, height));
  }
  if (!film_->done()) return;
  if (film_->result())
    note(ToastKind::kInfo, "Saved as " + film_->file().string());
  else
    note(ToastKind::kError, film_->result().error().message());
  film_.reset();
}

ScreenFilmModel WindowApp::film_model() const {
  ScreenFilmModel model;
  if (!film_) return model;
  model.on = true;
  model.ending = film_->ending();
  model.seconds = film_->ending() ? film_->seconds() : now_s_ - film_from_s_;
  model.megabytes = static_cast<double>(film_->bytes()) * 1e-6;
  model.file = film_->file().string();
  return model;
}

}  // namespace osteon
