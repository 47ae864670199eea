#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

#include "osteon/mesh/distance.h"

namespace osteon {

/// What heights are asked of: a surface's closest point, with a guess at the triangle, and its box.
struct HeightSource {
  Aabb box;
  std::function<ClosestPoint(const Vec3& p, std::uint32_t guess)> closest;
};

/// Signed distances of a surface at the nodes of a grid, each looked up when it is first asked for.
class NodeHeights {
 public:
  using Node = std::array<int, 3>;

  /// Nodes stand at lo + cell (i, j, k) with 0 <= i < size[0] and so on.
  NodeHeights(const HeightSource& surface, const Vec3& lo, double cell_m, const Node& size);
  /// Rounded to single precision, m.
  float at(const Node& node);
  /// Of any point near the last one asked for, exact.
  double exact(const Vec3& p);

 private:
  const HeightSource& surface_;
  Vec3 lo_;
  double cell_;
  Node blocks_{};
  std::vector<std::uint32_t> first_;  // of each block in `values_`; kNone where none is known
  std::vector<float> values_;         // NaN where not known
  std::uint32_t guess_ = 0;           // the last triangle found
};

}  // namespace osteon
