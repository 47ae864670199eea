#include "window/controllers/views/scene_pointer.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <utility>

namespace osteon {

void ScenePointer::hold_probe() {
  const ImGuiIO& io = ImGui::GetIO();
  const bool by_mouse = live_.run() && live_.run()->by_mouse();
  const bool space = glfwGetKey(host_.window->handle(), GLFW_KEY_SPACE) == GLFW_PRESS;
  if (!by_mouse) live_.let_probe_go();
  // While the tray is open the pointer is the tray's, and what is held waits where it is.
  const bool held = by_mouse && !hands_.tray_open() &&
                    (live_.probe_toggled() || (space && !io.WantTextInput && !io.NavVisible));
  if (held != live_.probe_held()) poll_.jump();
  // A card that keeps the keyboard would take End and the arrows, and V would run no motor.
  if (held && !live_.probe_held()) ImGui::SetWindowFocus(nullptr);
  live_.hold_probe(held);
}

void ScenePointer::poll(double dt_s, double wheel) {
  hold_probe();
  const ImGuiIO& io = ImGui::GetIO();
  GLFWwindow* const window = host_.window->handle();
  const bool nobody_types = !io.WantTextInput && !(io.NavActive && io.NavVisible);
  const bool keys_free = nobody_types && !io.KeyCtrl;
  input_ = poll_.read(window, wheel, keys_free, host_.window->pixel_ratio(), dt_s);
  input_.ctrl = io.KeyCtrl && !io.WantTextInput;
  input_.shift = input_.shift || (input_.ctrl && io.KeyShift);
  // ImGui remembers a click that was shorter than a picture.
  input_.left = input_.left || io.MouseDown[0];
  input_.right = input_.right || io.MouseDown[1];
  // A drag that begins in another view does not turn this one.
  const bool over_outside = sight_.shows_outside() && sight_.in_picture(input_.x, input_.y).inside;
  input_.over_panels = (io.WantCaptureMouse || !over_outside) && !live_.probe_held();
  move(input_);
  if (!live_.run()) return;
  // With Ctrl too, which moves what is held along its shaft: jaws must not open by that.
  live_.update(nobody_types && glfwGetKey(window, GLFW_KEY_V) == GLFW_PRESS, dt_s);
  hands_.poll_buttons();
}

void ScenePointer::move(SceneInput& input) {
  nudged_ = hands_.nudge_rested(input);
  if (notes_.poll_pointer(input)) input.left = false;
  if (edit_.poll_pointer(input)) {
    input.left = false;
    input.wheel = 0;
  }
  if (nudged_) return;
  const bool held = live_.probe_held();
  if (held && !input.right) {
    const std::optional<Vec3> portal_W = hands_.portal_near();
    return live_.run()->move_hand(probe_motion(input), sight_.hand_camera(), sight_.hand_viewport(),
                                  input.dt_s, portal_W ? &*portal_W : nullptr);
  }
  // With the probe in hand the right button orbits.
  if (held) std::swap(input.left, input.right);
  sight_.move_camera(input);
}

}  // namespace osteon
