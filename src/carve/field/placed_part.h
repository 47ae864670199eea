#pragma once

#include <algorithm>
#include <cmath>

#include "osteon/carve/cutter.h"

namespace osteon {

/// A part of a cutter where it is now, or the way of a ball. Lengths in Bone, metres.
struct PlacedPart {
  const CutterPart* part = nullptr;
  Pose X_BT;
  Vec3 way = Vec3::Zero();  ///< of a ball: on from X_BT; else nothing

  bool is_ball() const { return is_ball(*part); }
  static bool is_ball(const CutterPart& part) {
    return part.rods.size() == 1 && part.faces.empty() && part.planes.empty() &&
           part.rods[0].p0 == part.rods[0].p1;
  }
  Vec3 rod_start(const RoundRod& rod) const { return X_BT * rod.p0; }
  Vec3 rod_end(const RoundRod& rod) const { return X_BT * rod.p1 + way; }

  Aabb box() const {
    const Mat3 R = X_BT.q.toRotationMatrix();
    const Vec3 middle = X_BT * part->box.center();
    const Vec3 half = R.cwiseAbs() * (0.5 * part->box.extent());
    Aabb out{middle - half, middle + half};
    out.include(out.lo + way);
    out.include(out.hi + way);
    return out;
  }

  /// Never more than the way from a point to the part.
  double at_least(const Vec3& p_B) const {
    double most = -1e300;
    for (const RoundRod& rod : part->rods) {
      const Vec3 a = rod_start(rod), along = rod_end(rod) - a;
      const double length2 = along.squaredNorm();
      const double t = length2 > 0 ? std::clamp(along.dot(p_B - a) / length2, 0.0, 1.0) : 0.0;
      most = std::max(most, (p_B - a - t * along).norm() - rod.radius);
    }
    if (part->faces.empty() && part->planes.empty()) return most;
    const Vec3 p = X_BT.inverse() * p_B;
    const double rho = std::hypot(p.x(), p.y());
    for (const TurnedFace& f : part->faces)
      most = std::max(most, f.n_rho * rho + f.n_z * p.z() - f.offset);
    for (const Plane& plane : part->planes) most = std::max(most, plane.signed_distance(p));
    return most;
  }
};

}  // namespace osteon
