#include "largest_piece.h"

#include <algorithm>
#include <numeric>
#include <utility>
#include <vector>

namespace osteon {
namespace {

std::uint32_t root(std::vector<std::uint32_t>& parent, std::uint32_t v) {
  while (parent[v] != v) v = parent[v] = parent[parent[v]];
  return v;
}

}  // namespace

void keep_largest_piece(TriMesh& mesh) {
  if (mesh.triangles.empty()) return;
  std::vector<std::uint32_t> parent(mesh.vertices.size());
  std::iota(parent.begin(), parent.end(), 0u);
  for (const Triangle& t : mesh.triangles)
    for (const std::uint32_t v : {t[1], t[2]}) {
      const std::uint32_t a = root(parent, t[0]), b = root(parent, v);
      parent[std::max(a, b)] = std::min(a, b);
    }
  std::vector<std::size_t> size(mesh.vertices.size(), 0);
  for (const Triangle& t : mesh.triangles) ++size[root(parent, t[0])];
  const auto largest =
      static_cast<std::uint32_t>(std::max_element(size.begin(), size.end()) - size.begin());
  TriMesh kept;
  std::vector<std::uint32_t> index(mesh.vertices.size(), 0);
  for (std::uint32_t v = 0; v < mesh.vertices.size(); ++v) {
    if (root(parent, v) != largest) continue;
    index[v] = static_cast<std::uint32_t>(kept.vertices.size());
    kept.vertices.push_back(mesh.vertices[v]);
  }
  for (const Triangle& t : mesh.triangles)
    if (root(parent, t[0]) == largest)
      kept.triangles.push_back({index[t[0]], index[t[1]], index[t[2]]});
  mesh = std::move(kept);
}

}  // namespace osteon
