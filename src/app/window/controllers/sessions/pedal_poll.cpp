#define GLFW_INCLUDE_NONE
#include "window/controllers/sessions/pedal_poll.h"

#include <GLFW/glfw3.h>

namespace osteon {

PedalReadings read_pedals(GLFWwindow* window) {
  PedalReadings out;
  for (int key = GLFW_KEY_SPACE; key <= GLFW_KEY_LAST; ++key)
    if (glfwGetKey(window, key) == GLFW_PRESS) out.keys.push_back(key);
  for (int id = GLFW_JOYSTICK_1; id <= GLFW_JOYSTICK_LAST; ++id) {
    if (glfwJoystickPresent(id) != GLFW_TRUE) continue;
    ControllerReading stick;
    if (const char* name = glfwGetJoystickName(id)) stick.name = name;
    int count = 0;
    const float* axes = glfwGetJoystickAxes(id, &count);
    for (int i = 0; axes && i < count; ++i) stick.axes.push_back(static_cast<double>(axes[i]));
    const unsigned char* buttons = glfwGetJoystickButtons(id, &count);
    for (int i = 0; buttons && i < count; ++i) stick.buttons.push_back(buttons[i] == GLFW_PRESS);
    out.joysticks.push_back(std::move(stick));
  }
  return out;
}

}  // namespace osteon
