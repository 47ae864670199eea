#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "osteon/mesh/distance.h"

namespace osteon {

/// Signed distances of a mesh at the nodes of a grid, each looked up when it is first asked for.
class NodeHeights {
 public:
  using Node = std::array<int, 3>;

  /// Nodes stand at lo + cell (i, j, k) with 0 <= i < size[0] and so on.
  NodeHeights(const MeshDistance& mesh, const Vec3& lo, double cell_m, const Node& size);
  /// Rounded to single precision, m.
  float at(const Node& node);
  /// Of any point near the last one asked for, exact.
  double exact(const Vec3& p);

 private:
  const MeshDistance& mesh_;
  Vec3 lo_;
  double cell_;
  Node blocks_{};
  std::vector<std::uint32_t> first_;  // of each block in `values_`; kNone where none is known
  std::vector<float> values_;         // NaN where not known
  std::uint32_t guess_ = 0;           // the last triangle found
};

}  // namespace osteon
