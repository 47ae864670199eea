#pragma once

#include <string>

#include "osteon/base/result.h"

namespace osteon {

/// A graft that hangs on a button and is held in the tibia by a screw: what was done, m and N.
struct GraftFixing {
  double diameter_m = 0.008, length_m = 0.120;  ///< of the folded bundle
  double loop_m = 0.020;
  double channel_m = 0.040, socket_m = 0.026;  ///< of the femur
  double tibia_m = 0.040;                      ///< length of the tibial tunnel
  double tibia_diameter_m = 0.008;
  double between_m = 0.030;   ///< from mouth to mouth while it is fixed
  double button_gap_m = 0;    ///< soft tissue under the button
  double pretension_s = 600;  ///< on the bench, as if at 80 N
  double cycles = 25;         ///< of bending before the screw
  double screw_m = 0.009, screw_length_m = 0.028;
  double divergence_rad = 0;  ///< between screw and tunnel
};

/// What holds then.
struct FixedGraft {
  double in_socket_m = 0, in_tibia_m = 0;
  double engaged_m = 0;          ///< of the screw: where graft lies between it and the wall
  double stiffness_n_per_m = 0;  ///< of button, loop and screw, without the tendon
  double strength_n = 0;         ///< load at which the screw lets go
  double slack_m = 0;            ///< what creep, the button's gap and slip give away
  bool held = true;
  std::string why;  ///< it is not held
};

/// Series of springs and pieces of geometry.
///
/// Symbols: c channel, s socket, l loop, L graft, d distance of the mouths, t tibial tunnel; D
/// screw, T tunnel, theta divergence. Graft in the socket i = c - l; the button turns where i and 6
/// mm fit in s, or it stays in the bone. In the tibia lies min(t, L - i - d). The screw engages as
/// long as its axis is within T/2 of the tunnel's: min(its length, graft in the tibia, T / (2 tan
/// theta)). Strength: 20 N for each mm engaged (9 x 28 mm: 564 N, 10 x 35 mm: 665 N, K),
/// times 1 where the screw is 1 mm wider than the tunnel or more, 0.5 where it is as wide, 0 where
/// it is 1 mm narrower (E). Stiffness: button 600 N/mm, loop 12 kN / l, screw 300 N/mm over 28 mm:
/// together 150 N/mm for a loop of 20 mm, as assets/tissue/knee_ligaments.toml has it (D). Slack:
/// 3 % of the graft between loop and screw times what of creep is left (scene/graft.h),
/// the gap under the button, and slip of 1 mm for 564 N of strength, more in proportion for less
/// (E); the slip of a screw of full strength is in the tension that the table says is lost.
/// Fails on values out of range.
Result<FixedGraft> fix_graft(const GraftFixing& done);

}  // namespace osteon
