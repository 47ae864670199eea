#include "spring.h"

#include <cmath>

namespace osteon {

double spring_velocity(double m, double k, double c, double dt_s, double x, double v, double f) {
  return (m * v + dt_s * (f - k * x)) / (m + dt_s * c + dt_s * dt_s * k);
}

double damping_constant(double m, double k, double ratio) { return 2 * ratio * std::sqrt(k * m); }

Vec3 turn_between(const Quat& q_rest, const Quat& q) {
  const Quat relative = q_rest.conjugate() * q;
  // q and -q are one orientation: take the shorter way.
  return (relative.w() < 0 ? -2.0 : 2.0) * relative.vec();
}

Quat limit_turn(const Quat& q_rest, const Quat& q, double max_turn, bool* limited) {
  const Vec3 turn = turn_between(q_rest, q);
  const double length = turn.norm();
  *limited = length > max_turn;
  if (!*limited) return q;
  const Vec3 half = turn * (0.5 * max_turn / length);
  const double w = std::sqrt(1 - half.squaredNorm());
  return (q_rest * Quat(w, half.x(), half.y(), half.z())).normalized();
}

}  // namespace osteon
