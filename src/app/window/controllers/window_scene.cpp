#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <algorithm>
#include <cmath>

#include "window/controllers/pedal_poll.h"
#include "window/window_app.h"

namespace osteon {

// The cards float over the picture's sides.
CoveredEdges WindowApp::covered_edges() const {
  if (!settings_.panels_open || picture_layout() != PictureLayout::kOutside) return {};
  const ImVec2 size = ImGui::GetIO().DisplaySize;
  const UiLayout layout =
      make_layout(size.x, size.y, ui_->scale(), true, static_cast<float>(settings_.left_card));
  const double width = std::max(1.0, static_cast<double>(layout.picture.w));
  const double left = static_cast<double>(layout.left.right()) / width;
  const double right = static_cast<double>(layout.picture.right() - layout.right.x) / width;
  return {left, right, 0, 0};
}

void WindowApp::hold_probe(bool held) {
  if (held == probe_held_) return;
  probe_held_ = held;
  // The pointer must not stop at the window's edge while it moves the probe.
  glfwSetInputMode(window_->handle(), GLFW_CURSOR,
                   held ? GLFW_CURSOR_DISABLED : GLFW_CURSOR_NORMAL);
  ui_->take_pointer(held);
  poll_.jump();
}

void WindowApp::pick_under_pointer(const SceneInput& input) {
  const Viewport v = viewport();
  pointer_x_ = input.x;
  pointer_y_ = input.y;
  hovered_ = {};
  // A pointer that merely lies there points at nothing.
  pointer_moved_ = pointer_moved_ || input.dx != 0 || input.dy != 0;
  if (!pointer_moved_) return;
  if (input.over_panels || probe_held_ || control_.dragging() || !shows_outside()) return;
  int width = 0, height = 0;
  window_->framebuffer_size(width, height);
  const double x = input.x - v.x;
  const double y = input.y - (height - v.y - v.height);
  if (x < 0 || y < 0 || x >= v.width || y >= v.height) return;
  hovered_ = renderer_->pick(shown_, view_, v, x, y);
  if (control_.clicked()) picked_ = hovered_ == picked_ ? BoneId{} : hovered_;
}

HandWishes WindowApp::poll_pedals() {
  const PedalReadings readings = read_pedals(window_->handle());
  learn_pedal(readings);
  pedals_.update(readings);
  HandWishes wishes;
  wishes.has_dead_man = pedals_.has(kDeadManPedal);
  wishes.dead_man_held = pedals_.held(kDeadManPedal);
  wishes.clutch = pedals_.held(kClutchPedal);
  return wishes;
}

// A drag that begins in another view does not turn this one.
bool WindowApp::over_outside(const SceneInput& input) const {
  if (!shows_outside()) return false;
  const Viewport v = viewport();
  int width = 0, height = 0;
  window_->framebuffer_size(width, height);
  const double x = input.x - v.x, y = input.y - (height - v.y - v.height);
  return x >= 0 && y >= 0 && x < v.width && y < v.height;
}

void WindowApp::poll_scene(double dt_s, double wheel) {
  const ImGuiIO& io = ImGui::GetIO();
  const bool by_mouse = live_ && live_->by_mouse();
  const bool space = glfwGetKey(window_->handle(), GLFW_KEY_SPACE) == GLFW_PRESS;
  if (!by_mouse) probe_toggled_ = false;
  hold_probe(by_mouse && (probe_toggled_ || (space && !io.WantTextInput && !io.NavVisible)));

  const bool keys_free = !io.WantTextInput && !io.KeyCtrl && !(io.NavActive && io.NavVisible);
  SceneInput input = poll_.read(window_->handle(), wheel, keys_free, window_->pixel_ratio(), dt_s);
  // ImGui remembers a click that was shorter than a picture.
  input.left = input.left || io.MouseDown[0];
  input.right = input.right || io.MouseDown[1];
  input.over_panels = (io.WantCaptureMouse || !over_outside(input)) && !probe_held_;
  const bool nudged = nudge_rested(input);
  if (poll_edit(input)) {
    input.left = false;
    input.wheel = 0;
  }
  if (nudged) {
    pick_under_pointer(input);
  } else if (probe_held_ && !input.right) {
    live_->move_hand(probe_motion(input), hand_camera(), hand_viewport(), dt_s, portal_near());
  } else {
    // With the probe in hand the right button orbits.
    if (probe_held_) std::swap(input.left, input.right);
    view_.camera = control_.update(view_.camera, input, viewport());
  }
  if (live_) {
    live_->move_pad(read_gamepad(), view_.camera);
    live_->tell_hand(poll_pedals(), view_.camera);
    const bool key = keys_free && glfwGetKey(window_->handle(), GLFW_KEY_V) == GLFW_PRESS;
    live_->drive(std::max(key ? 1.0 : 0.0, pedals_.value(kPowerPedal)));
    live_->update();
    shown_ = live_->snapshot();
    if (const std::string why = live_->take_recording_failure(); !why.empty())
      note(ToastKind::kError, why);
    if (const std::string why = live_->take_harmless_trip(); !why.empty())
      note(ToastKind::kInfo, why);
    poll_device_buttons();
  }
  if (player_ && replay_) {
    player_->advance(dt_s);
    shown_ = replay_->track.at(player_->position_s());
    replay_force_ = replay_->track.force_until(player_->position_s(),
                                               static_cast<std::size_t>(8 * kForceHistoryHz));
  }
  show_bend();
  pick_under_pointer(input);
}

}  // namespace osteon
