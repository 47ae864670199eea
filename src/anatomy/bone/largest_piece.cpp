#include "bone/largest_piece.h"

#include <algorithm>
#include <utility>

#include "osteon/base/union_find.h"

namespace osteon {

std::vector<std::uint32_t> piece_of_vertices(const TriMesh& mesh) {
  UnionFind pieces(mesh.vertices.size());
  for (const Triangle& t : mesh.triangles)
    for (const std::uint32_t v : {t[1], t[2]}) pieces.join(t[0], v);
  return pieces.names();
}

std::vector<std::uint32_t> largest_pieces(const TriMesh& mesh, std::size_t count) {
  const std::vector<std::uint32_t> piece = piece_of_vertices(mesh);
  std::vector<std::size_t> size(mesh.vertices.size(), 0);
  for (const Triangle& t : mesh.triangles) ++size[piece[t[0]]];
  std::vector<std::uint32_t> pieces;
  for (std::uint32_t v = 0; v < size.size(); ++v)
    if (size[v] > 0) pieces.push_back(v);
  std::stable_sort(pieces.begin(), pieces.end(),
                   [&](std::uint32_t a, std::uint32_t b) { return size[a] > size[b]; });
  if (pieces.size() > count) pieces.resize(count);
  return pieces;
}

TriMesh take_pieces(const TriMesh& mesh, const std::vector<std::uint32_t>& wanted) {
  const std::vector<std::uint32_t> piece = piece_of_vertices(mesh);
  const auto is_wanted = [&](std::uint32_t v) {
    return std::find(wanted.begin(), wanted.end(), piece[v]) != wanted.end();
  };
  TriMesh taken;
  std::vector<std::uint32_t> index(mesh.vertices.size(), 0);
  for (std::uint32_t v = 0; v < mesh.vertices.size(); ++v) {
    if (!is_wanted(v)) continue;
    index[v] = static_cast<std::uint32_t>(taken.vertices.size());
    taken.vertices.push_back(mesh.vertices[v]);
  }
  for (const Triangle& t : mesh.triangles)
    if (is_wanted(t[0])) taken.triangles.push_back({index[t[0]], index[t[1]], index[t[2]]});
  return taken;
}

void keep_largest_pieces(TriMesh& mesh, std::size_t count) {
  if (mesh.triangles.empty()) return;
  mesh = take_pieces(mesh, largest_pieces(mesh, count));
}

}  // namespace osteon
