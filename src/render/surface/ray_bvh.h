#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "osteon/base/types.h"

namespace osteon {

struct RayHit {
  double t = 0;  ///< distance along the ray, in lengths of its direction
  std::uint32_t triangle = 0;
};

/// Bounding volume hierarchy over triangles, for rays. Triangles with vertices that are missing or
/// not finite are never hit. Both sides of a triangle count.
class RayBvh {
 public:
  RayBvh() = default;
  RayBvh(std::span<const Vec3> vertices, std::span<const Triangle> triangles);

  bool empty() const { return nodes_.empty(); }
  /// First triangle hit with 0 < t < t_max.
  std::optional<RayHit> closest(const Vec3& origin, const Vec3& dir, double t_max) const;

 private:
  /// Children of an inner node are `first` and `first + 1`; a leaf holds faces_[first, +count).
  struct Node {
    Aabb box;
    std::uint32_t first = 0, count = 0;
  };
  struct Face {
    Vec3 a, ab, ac;
    std::uint32_t triangle;
  };
  void split(std::uint32_t node, int depth);

  std::vector<Node> nodes_;
  std::vector<Face> faces_;
};

}  // namespace osteon
