#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <cstdint>

namespace osteon {

using Vec3 = Eigen::Vector3d;
using Mat3 = Eigen::Matrix3d;
using Quat = Eigen::Quaternion<double, Eigen::DontAlign>;

/// Rigid pose X_AB: takes coordinates in frame B to coordinates in frame A (metres).
/// `q` is a unit quaternion; the default is the identity.
struct Pose {
  Vec3 p = Vec3::Zero();
  Quat q = Quat::Identity();

  Vec3 operator*(const Vec3& p_B) const { return q * p_B + p; }
  Pose operator*(const Pose& X_BC) const { return {q * X_BC.p + p, q * X_BC.q}; }
  Pose inverse() const {
    const Quat qi = q.conjugate();
    return {-(qi * p), qi};
  }
  /// Turns a direction (no translation).
  Vec3 rotate(const Vec3& v_B) const { return q * v_B; }
};

/// Axis-aligned box; empty (lo > hi) by default.
struct Aabb {
  Vec3 lo = Vec3::Constant(1e300);
  Vec3 hi = Vec3::Constant(-1e300);

  void include(const Vec3& p) {
    lo = lo.cwiseMin(p);
    hi = hi.cwiseMax(p);
  }
  bool empty() const { return lo.x() > hi.x(); }
  bool overlaps(const Aabb& o) const {
    return (lo.array() <= o.hi.array()).all() && (o.lo.array() <= hi.array()).all();
  }
  Aabb grown(double margin) const {
    return {lo - Vec3::Constant(margin), hi + Vec3::Constant(margin)};
  }
  Vec3 center() const { return 0.5 * (lo + hi); }
  Vec3 extent() const { return hi - lo; }
};

/// Oriented plane: a point x is inside when n.x <= d. `n` is a unit vector.
struct Plane {
  Vec3 n = Vec3::UnitZ();
  double d = 0;
  double signed_distance(const Vec3& x) const { return n.dot(x) - d; }
};

using Triangle = std::array<std::uint32_t, 3>;

inline bool is_finite(const Vec3& v) { return v.array().isFinite().all(); }
inline bool is_finite(const Pose& X) {
  return is_finite(X.p) && X.q.coeffs().array().isFinite().all();
}

}  // namespace osteon
