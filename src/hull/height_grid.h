#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "osteon/mesh/distance.h"

namespace osteon::hull {

/// Signed distance to a closed mesh, interpolated between the nodes of a grid. A node is looked up
/// in the mesh when it is first needed: a search asks millions of times about the same few places.
class HeightGrid {
 public:
  /// `work` bounds what may be asked of it before it is worn out; it answers all the same.
  HeightGrid(const TriMesh& mesh, double cell_m, std::uint64_t work = ~std::uint64_t{0});

  /// Height of a point over the surface (negative inside), m, trilinear; outside the grid that of
  /// the nearest place inside.
  double at(const Vec3& p);
  /// Direction in which the height rises, unit; zero where it does not.
  Vec3 upwards(const Vec3& p);
  double cell() const { return cell_; }
  /// Takes from the work that is left: one unit is one question for a height.
  void spend(std::uint64_t units) { work_left_ -= std::min(work_left_, units); }
  bool worn_out() const { return work_left_ == 0; }
  std::uint64_t work_left() const { return work_left_; }
  const MeshDistance& exact() const { return exact_; }

 private:
  using Node = std::array<std::uint32_t, 3>;
  /// Heights of a cell's corners, x fastest, then y, then z.
  using Corners = std::array<double, 8>;
  /// Those of a cell within one block, NaN where not known; false when they lie in several or the
  /// block is not there.
  bool known_corners(const Node& cell, Corners& corners) const;
  Corners make_corners(const Node& cell);
  double value(const Node& node);
  std::size_t block_of(const Node& node) const;

  MeshDistance exact_;
  std::uint64_t work_left_;
  Vec3 lo_;
  double cell_;
  Node size_{};                       // nodes
  Node blocks_{};                     // blocks of nodes
  std::vector<std::uint32_t> first_;  // of each block in `values_`; kNone where none is known
  std::vector<double> values_;        // NaN where not known
  std::uint32_t last_ = 0;            // triangle of the mesh near the node last looked up
};

}  // namespace osteon::hull
