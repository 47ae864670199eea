#pragma once

#include "osteon/device/pad_device.h"

namespace osteon {

/// What a gamepad says, in the camera's axes.
struct PadSticks {
  PadAxes axes_C;
  bool for_rested = false;  ///< its second button is held: the sticks are the resting hand's
};

/// A small move of a resting hand: along its shaft (in is positive), about its shaft, and about
/// the camera's axes to the right and up.
struct RestNudge {
  double in_m = 0, about_rad = 0, pitch_rad = 0, yaw_rad = 0;

  bool moves() const { return in_m != 0 || about_rad != 0 || pitch_rad != 0 || yaw_rad != 0; }
};

/// How far the sticks move a resting hand in `dt_s`: the left stick up or the right trigger in,
/// the left stick down or the left trigger out, the bumpers about the shaft, the right stick
/// tilts. Nothing from a gamepad that is not connected, nor for a time that is not positive.
RestNudge pad_nudge(const PadAxes& axes_C, double dt_s);

/// The same gamepad with its sticks let go of.
PadAxes at_rest(PadAxes axes);

}  // namespace osteon
