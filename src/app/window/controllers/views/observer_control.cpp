#include "window/controllers/views/observer_control.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <utility>

namespace osteon {
namespace {

constexpr int kKeyEscape = 256, kKeyV = 'V';  // GLFW's numbers

}  // namespace

void ObserverControl::open() {
  bool own_screen = false;
  auto opened = ObserverWindow::open(*host_.window, own_screen);
  if (!opened) return host_.note(ToastKind::kError, opened.error().message());
  observer_ = std::move(*opened);
  if (!own_screen)
    host_.note(ToastKind::kInfo,
               "There is only one screen, so the second window is an ordinary one. Choose what it "
               "shows under View, or press V in it.");
}

void ObserverControl::toggle() {
  if (observer_)
    observer_.reset();
  else
    open();
}

bool ObserverControl::poll() {
  if (!observer_) return false;
  bool escaped = false;
  for (const int key : observer_->take_pressed_keys()) {
    escaped = escaped || key == kKeyEscape;
    if (key == kKeyV) layout_ = next_layout(layout_);
  }
  if (observer_->came_back())
    host_.note(ToastKind::kWarning,
               "The second screen was disconnected. Its window is now on this screen.");
  if (observer_->closed()) observer_.reset();
  return escaped;
}

// In its pixels.
std::vector<Pane> ObserverControl::panes() const {
  int width = 0, height = 0;
  observer_->size(width, height);
  return panes_of(layout_, {0, 0, static_cast<float>(width), static_cast<float>(height)},
                  host_.ui->scale(), scene_.views.has_shot());
}

int ObserverControl::scope_px() const {
  if (!observer_) return 0;
  float side = 0;
  for (const Pane& pane : panes())
    if (pane.kind == PaneKind::kScope) side = std::min(pane.area.w, pane.area.h);
  return static_cast<int>(side);
}

void ObserverControl::draw(const ViewState& looks) {
  if (!observer_ || !observer_->due(host_.now_s) || !scene_.renderer || !scene_.the_case) return;
  int width = 0, height = 0;
  observer_->size(width, height);
  if (width <= 0 || height <= 0) return;
  picture_.resize(width, height);
  glBindFramebuffer(GL_FRAMEBUFFER, picture_.framebuffer());
  fill_viewport({0, 0, width, height}, 0, 0, 0);
  for (const Pane& pane : panes()) {
    const UiRect& r = pane.area;
    const Viewport at{static_cast<int>(r.x), height - static_cast<int>(r.bottom()),
                      static_cast<int>(r.w), static_cast<int>(r.h)};
    PictureViews& views = scene_.views;
    if (pane.kind == PaneKind::kOutside) views.draw_outside(at, looks);
    if (pane.kind == PaneKind::kScope) views.draw_scope(at, std::min(at.width, at.height));
    if (pane.kind == PaneKind::kPanorama) views.draw_panorama(at, true);
    if (pane.kind == PaneKind::kFluoro) views.draw_fluoro(at);
  }
  glBindFramebuffer(GL_FRAMEBUFFER, 0);
  observer_->show(picture_, host_.now_s);
}

}  // namespace osteon
