#pragma once

#include <limits>
#include <optional>

#include "osteon/base/types.h"
#include "osteon/mesh/distance.h"

namespace osteon {

inline double distance_to_box(const Vec3& p, const Aabb& box) {
  return (box.lo - p).cwiseMax(p - box.hi).cwiseMax(0.0).norm();
}

/// A closed surface that is asked for one point after the other, most of them near the one before.
/// Since a distance changes by no more than the way, many need no search. For one thread; the
/// surface must live longer.
class NearbySurface {
 public:
  NearbySurface(const MeshDistance& surface, const Aabb& box) : surface_(&surface), box_(box) {}

  const Aabb& box() const { return box_; }
  const MeshDistance& surface() const { return *surface_; }

  /// The closest point; none where its signed distance surely is `limit` or more.
  std::optional<ClosestPoint> nearer_than(double limit, const Vec3& p);

 private:
  const MeshDistance* surface_;
  Aabb box_;
  Vec3 last_ = Vec3::Zero();
  ClosestPoint at_last_ = {Vec3::Zero(), std::numeric_limits<std::uint32_t>::max(),
                           -std::numeric_limits<double>::infinity()};
};

}  // namespace osteon
