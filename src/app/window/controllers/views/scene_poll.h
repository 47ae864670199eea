#pragma once

#include "runs/hands/pad_nudge.h"
#include "runs/hands/probe_drag.h"
#include "ui/scene_input.h"

struct GLFWwindow;

namespace osteon {

/// Reads pointer and keys of a window once a frame.
class ScenePoll {
 public:
  /// `wheel`: notches since the last frame. Keys count only when `keys_free` (no text field or
  /// panel has them). `pixel_ratio`: framebuffer pixels a screen coordinate.
  SceneInput read(GLFWwindow* window, double wheel, bool keys_free, double pixel_ratio,
                  double dt_s);
  /// Forgets the pointer's last place, after the cursor was captured or freed.
  void jump() { known_ = false; }

 private:
  bool known_ = false;
  double x_ = 0, y_ = 0;
};

/// The part of the input that moves a probe held by the mouse. With Shift the wheel goes in fine
/// steps, and the keys that roll turn it about its own shaft.
ProbeMotion probe_motion(const SceneInput& input);

/// The first gamepad, in the camera's axes; `connected` is false when there is none.
PadSticks read_gamepad();

}  // namespace osteon
