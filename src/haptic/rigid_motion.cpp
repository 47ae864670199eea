#include "rigid_motion.h"

#include <algorithm>
#include <cmath>

namespace osteon {

Pose carried_forward(const BoneMotion& motion, double age_s) {
  if (motion.v_W.isZero(0) && motion.w_W.isZero(0)) return motion.X_WB;
  const Vec3 half = 0.5 * age_s * motion.w_W;
  const Quat turn(1, half.x(), half.y(), half.z());
  return {motion.X_WB.p + age_s * motion.v_W, (turn * motion.X_WB.q).normalized()};
}

Quat turned_towards(const Quat& from, const Quat& to, double limit_rad) {
  Quat d = to * from.conjugate();
  if (d.w() < 0) d.coeffs() = -d.coeffs();
  const double sine = d.vec().norm();  // of half the angle
  // What no longer turns keeps its bits: then what is known of bone beside it stays known.
  if (sine < 1e-13) return from;
  const double limit_sine = std::sin(0.5 * std::min(limit_rad, 3.14));
  if (sine <= limit_sine) return to;
  const Vec3 v = d.vec() * (limit_sine / sine);
  const Quat step(std::sqrt(1 - limit_sine * limit_sine), v.x(), v.y(), v.z());
  return (step * from).normalized();
}

// The sine of half the angle is at least its share pi / 2 of it, and nearly all of it when small.
double angle_between(const Quat& a, const Quat& b) {
  const double sine = (a.conjugate() * b).vec().norm();
  return sine < 0.1 ? 2.01 * sine : 3.15 * sine;
}

Vec3 velocity_at(const BoneMotion& motion, const Vec3& p_W) {
  return motion.v_W + motion.w_W.cross(p_W - motion.X_WB.p);
}

double travel(const Pose& before_WB, const Pose& now_WB, const Vec3& p_W, double reach_m) {
  if (same_pose(before_WB, now_WB)) return 0;
  const double at_p = (before_WB * (now_WB.inverse() * p_W) - p_W).norm();
  const double turn = 2 * (before_WB.q.conjugate() * now_WB.q).vec().norm();
  return at_p + turn * reach_m;
}

}  // namespace osteon
