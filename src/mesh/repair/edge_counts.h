#pragma once

#include <array>
#include <cstdint>
#include <utility>
#include <vector>

#include "osteon/mesh/tri_mesh.h"

namespace osteon {

/// Number of triangles on each edge, kept up to date while triangles go.
class EdgeCounts {
 public:
  explicit EdgeCounts(const TriMesh& mesh);
  /// Of the edges from each corner of a triangle of the mesh to the next.
  std::array<int, 3> of(const Triangle& t) const;
  void add(const Triangle& t, int change);

 private:
  std::size_t index(std::uint32_t a, std::uint32_t b) const;

  std::vector<std::pair<std::uint32_t, std::uint32_t>> edges_;  ///< sorted
  std::vector<int> counts_;
};

}  // namespace osteon
