#pragma once

#include "runs/hands/pedals.h"

struct GLFWwindow;

namespace osteon {

/// Keys and joysticks as they are now. Of the window's thread.
PedalReadings read_pedals(GLFWwindow* window);

}  // namespace osteon
