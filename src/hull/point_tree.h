#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "cloud.h"
#include "shell.h"

namespace osteon::hull {

/// Tree of cylinders over the survivors. A cylinder stands along its points' mean normal, so on a
/// convex surface it is as thin as the surface's sagitta, and a plane that touches the surface
/// misses nearly all of them.
class PointTree {
 public:
  static constexpr std::uint32_t kLeafSize = 8;

  /// The cloud holds the shell's survivors, in their order.
  PointTree(const Cloud& survivors, const Shell& shell);

  struct Node {
    double cx, cy, cz;           ///< middle of the cylinder, frame S
    double mx, my, mz;           ///< its axis, unit
    double half_height, radius;  ///< padded for rounding
    std::uint32_t begin, end;    ///< its places
    std::uint32_t right;         ///< second child; the first follows its parent. 0: a leaf
    bool leaf() const { return right == 0; }
    /// Upper bound on the height of its points over the plane.
    double highest(const FilterPlane& plane) const;
  };

  const Node& node(std::uint32_t i) const { return nodes_[i]; }
  std::uint32_t leaf_of(std::uint32_t point) const { return leaf_of_[point]; }
  /// Heights of kLeafSize places from `begin` on; those past the leaf's end mean nothing.
  void heights(std::uint32_t begin, const FilterPlane& plane, double* out) const {
    const double* x = x_.data() + begin;
    const double* y = y_.data() + begin;
    const double* z = z_.data() + begin;
    for (std::uint32_t i = 0; i < kLeafSize; ++i) {
      out[i] = (plane.nx * x[i] + plane.ny * y[i]) + (plane.nz * z[i] - plane.d);
    }
  }
  /// The survivor at a place of the leaves' order.
  std::uint32_t point_at(std::uint32_t place) const { return order_[place]; }

 private:
  std::uint32_t build(std::uint32_t begin, std::uint32_t end, const Cloud& survivors,
                      std::span<const Vec3> normals_S);

  std::vector<Node> nodes_;
  std::vector<std::uint32_t> leaf_of_;
  std::vector<std::uint32_t> order_;
  std::vector<double> x_, y_, z_;  ///< frame S, longer by a leaf
};

}  // namespace osteon::hull
