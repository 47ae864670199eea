#pragma once

namespace osteon {

/// Pointer and keys over the picture in one frame; framebuffer pixels from the window's top left.
struct SceneInput {
  double x = 0, y = 0;
  double dx = 0, dy = 0;  ///< since the last frame
  double wheel = 0;       ///< notches, positive away from the user
  bool left = false, middle = false, right = false, shift = false, ctrl = false;
  double turn_right = 0, turn_up = 0;   ///< arrow keys, each in [-1, 1]
  double zoom_in = 0;                   ///< + and - keys
  double pitch = 0, yaw = 0, roll = 0;  ///< W S, A D, Q E
  bool over_panels = false;             ///< a panel has the pointer
  double dt_s = 0;
};

}  // namespace osteon
