#pragma once

#include "osteon/base/types.h"

namespace osteon {

/// Velocity after a step `dt_s` of backward Euler for m v' = f - k x - c v, x' = v, from (x, v) at
/// its begin:
///   v1 = (m v + dt (f - k x)) / (m + dt c + dt^2 k).
/// With the position then moved by dt v1 the energy of the unforced motion never grows, whatever m,
/// k, c >= 0 and dt are. The same holds for a rotation about a principal axis with the moment of
/// inertia as m and the angle as x.
double spring_velocity(double m, double k, double c, double dt_s, double x, double v, double f);

/// Damping constant of a spring: 2 ratio sqrt(k m). Ratio 1 is critical.
double damping_constant(double m, double k, double ratio);

/// The turn from `q_rest` to `q` as a vector along its axis of length 2 sin(angle / 2), in the
/// turned frame: the angle for small turns, and the gradient of the energy 4 k (1 - cos(angle / 2))
/// for all.
Vec3 turn_between(const Quat& q_rest, const Quat& q);

/// `q`, or the orientation on the way from `q_rest` to it whose turn has the length `max_turn`.
/// True in `limited` for the latter.
Quat limit_turn(const Quat& q_rest, const Quat& q, double max_turn, bool* limited);

}  // namespace osteon
