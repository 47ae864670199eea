#include "repair/edge_counts.h"

#include <algorithm>

#include "repair/edges.h"

namespace osteon {

EdgeCounts::EdgeCounts(const TriMesh& mesh) {
  for_each_edge(edge_uses(mesh.triangles), [this](auto first, auto last) {
    edges_.push_back({first->lo, first->hi});
    counts_.push_back(static_cast<int>(last - first));
  });
}

std::size_t EdgeCounts::index(std::uint32_t a, std::uint32_t b) const {
  const std::pair<std::uint32_t, std::uint32_t> edge = std::minmax(a, b);
  return static_cast<std::size_t>(std::lower_bound(edges_.begin(), edges_.end(), edge) -
                                  edges_.begin());
}

std::array<int, 3> EdgeCounts::of(const Triangle& t) const {
  return {counts_[index(t[0], t[1])], counts_[index(t[1], t[2])], counts_[index(t[2], t[0])]};
}

void EdgeCounts::add(const Triangle& t, int change) {
  for (std::size_t k = 0; k < 3; ++k) counts_[index(t[k], t[(k + 1) % 3])] += change;
}

}  // namespace osteon
