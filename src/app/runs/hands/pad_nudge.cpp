#include "runs/hands/pad_nudge.h"

#include <algorithm>

namespace osteon {

RestNudge pad_nudge(const PadAxes& axes_C, double dt_s) {
  constexpr double kSpeed_m_per_s = 0.02, kTurn_rad_per_s = 0.9;  // the keys turn as fast
  if (!axes_C.connected || !(dt_s > 0)) return {};
  const double dead_zone = PadParams{}.dead_zone;
  const Vec3 move = past_dead_zone(axes_C.move_V, dead_zone);
  const Vec3 turn = past_dead_zone(axes_C.turn_V, dead_zone);
  RestNudge by;
  by.in_m = dt_s * kSpeed_m_per_s * std::clamp(move.y() - move.z(), -1.0, 1.0);
  by.pitch_rad = dt_s * kTurn_rad_per_s * turn.x();
  by.yaw_rad = dt_s * kTurn_rad_per_s * turn.y();
  by.about_rad = dt_s * kTurn_rad_per_s * turn.z();
  return by;
}

PadAxes at_rest(PadAxes axes) {
  axes.move_V = axes.turn_V = Vec3::Zero();
  return axes;
}

}  // namespace osteon
