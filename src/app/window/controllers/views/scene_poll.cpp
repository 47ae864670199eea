#include "window/controllers/views/scene_poll.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

namespace osteon {
namespace {

constexpr double kFine = 0.25;  // of a notch, with Shift

double between_keys(GLFWwindow* window, int minus, int plus) {
  const auto down = [window](int key) { return glfwGetKey(window, key) == GLFW_PRESS ? 1.0 : 0.0; };
  return down(plus) - down(minus);
}

bool button(GLFWwindow* window, int which) {
  return glfwGetMouseButton(window, which) == GLFW_PRESS;
}

}  // namespace

SceneInput ScenePoll::read(GLFWwindow* window, double wheel, bool keys_free, double pixel_ratio,
                           double dt_s) {
  SceneInput input;
  input.dt_s = dt_s;
  input.wheel = wheel;
  double x = 0, y = 0;
  glfwGetCursorPos(window, &x, &y);
  input.x = x * pixel_ratio;
  input.y = y * pixel_ratio;
  if (known_) {
    input.dx = input.x - x_;
    input.dy = input.y - y_;
  }
  known_ = true;
  x_ = input.x;
  y_ = input.y;
  input.left = button(window, GLFW_MOUSE_BUTTON_LEFT);
  input.middle = button(window, GLFW_MOUSE_BUTTON_MIDDLE);
  input.right = button(window, GLFW_MOUSE_BUTTON_RIGHT);
  if (!keys_free) return input;
  input.shift = glfwGetKey(window, GLFW_KEY_LEFT_SHIFT) == GLFW_PRESS ||
                glfwGetKey(window, GLFW_KEY_RIGHT_SHIFT) == GLFW_PRESS;
  input.turn_right = between_keys(window, GLFW_KEY_LEFT, GLFW_KEY_RIGHT);
  input.turn_up = between_keys(window, GLFW_KEY_DOWN, GLFW_KEY_UP);
  input.zoom_in = between_keys(window, GLFW_KEY_MINUS, GLFW_KEY_EQUAL);
  input.pitch = between_keys(window, GLFW_KEY_W, GLFW_KEY_S);
  input.yaw = between_keys(window, GLFW_KEY_A, GLFW_KEY_D);
  input.roll = between_keys(window, GLFW_KEY_E, GLFW_KEY_Q);
  return input;
}

ProbeMotion probe_motion(const SceneInput& input) {
  ProbeMotion motion;
  motion.right_px = input.dx;
  motion.up_px = -input.dy;
  (input.ctrl ? motion.along : motion.wheel) = input.shift ? kFine * input.wheel : input.wheel;
  motion.pitch = input.pitch;
  motion.yaw = input.yaw;
  (input.shift ? motion.twist : motion.roll) = input.roll;
  return motion;
}

// The first one: pedals and other joysticks may stand before it in the list.
bool read_first_gamepad(GLFWgamepadstate& state) {
  for (int id = GLFW_JOYSTICK_1; id <= GLFW_JOYSTICK_LAST; ++id)
    if (glfwGetGamepadState(id, &state) == GLFW_TRUE) return true;
  return false;
}

PadSticks read_gamepad() {
  PadSticks sticks;
  PadAxes& axes = sticks.axes_C;
  GLFWgamepadstate state;
  axes.connected = read_first_gamepad(state);
  if (!axes.connected) return sticks;
  const auto axis = [&state](int i) { return static_cast<double>(state.axes[i]); };
  const auto held = [&state](int i) { return state.buttons[i] == GLFW_PRESS ? 1.0 : 0.0; };
  // Triggers rest at -1.
  const double deeper = 0.5 * (axis(GLFW_GAMEPAD_AXIS_RIGHT_TRIGGER) + 1);
  const double nearer = 0.5 * (axis(GLFW_GAMEPAD_AXIS_LEFT_TRIGGER) + 1);
  axes.move_V =
      Vec3(axis(GLFW_GAMEPAD_AXIS_LEFT_X), -axis(GLFW_GAMEPAD_AXIS_LEFT_Y), nearer - deeper);
  axes.turn_V =
      Vec3(axis(GLFW_GAMEPAD_AXIS_RIGHT_Y), axis(GLFW_GAMEPAD_AXIS_RIGHT_X),
           held(GLFW_GAMEPAD_BUTTON_LEFT_BUMPER) - held(GLFW_GAMEPAD_BUTTON_RIGHT_BUMPER));
  axes.buttons = state.buttons[GLFW_GAMEPAD_BUTTON_A] == GLFW_PRESS ? 1u : 0u;
  sticks.for_rested = state.buttons[GLFW_GAMEPAD_BUTTON_B] == GLFW_PRESS;
  return sticks;
}

}  // namespace osteon
