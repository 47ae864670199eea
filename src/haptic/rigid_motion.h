#pragma once

#include "osteon/base/types.h"
#include "osteon/scene/state.h"

namespace osteon {

/// Pose of a bone `age_s` after its snapshot, moving on with its velocities. The rotation over the
/// age is the Cayley map's, which differs from the exact one by (w age)^3 / 12 rad.
Pose carried_forward(const BoneMotion& motion, double age_s);

/// Angle between two turns, rad; no less than the exact one.
double angle_between(const Quat& a, const Quat& b);

/// From `from` towards `to` by the shorter way, by at most `limit_rad`. Unit quaternions.
Quat turned_towards(const Quat& from, const Quat& to, double limit_rad);

/// q * v to the bit. Eigen's own is a call, and the planes of a tick ask for hundreds.
inline Vec3 turned(const Quat& q, const Vec3& v) {
  const Vec3 u(q.x(), q.y(), q.z());
  Vec3 uv = u.cross(v);
  uv += uv;
  return v + q.w() * uv + u.cross(uv);
}

/// Velocity of the bone's material at p_W.
Vec3 velocity_at(const BoneMotion& motion, const Vec3& p_W);

/// Whether nothing has moved.
inline bool same_pose(const Pose& a, const Pose& b) {
  return a.p == b.p && a.q.coeffs() == b.q.coeffs();
}

/// How far the material of a moving bone goes at most within `reach_m` of p_W, m.
double travel(const Pose& before_WB, const Pose& now_WB, const Vec3& p_W, double reach_m);

}  // namespace osteon
