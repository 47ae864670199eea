#include "repair/patches.h"

#include <limits>
#include <utility>

#include "repair/edges.h"

namespace osteon {
namespace {

constexpr std::uint32_t kNoTriangle = std::numeric_limits<std::uint32_t>::max();

struct Neighbour {
  std::uint32_t triangle = kNoTriangle;
  bool alike = true;
};

// Across the edges that have exactly two triangles.
struct Neighbours {
  explicit Neighbours(const std::vector<Triangle>& triangles) : of(triangles.size()) {
    const std::vector<EdgeUse> uses = edge_uses(triangles);
    for_each_edge(uses, [this](auto first, auto last) {
      if (last - first != 2) return;
      const EdgeUse& a = *first;
      const EdgeUse& b = *(first + 1);
      const bool alike = a.ascending != b.ascending;
      of[a.triangle][a.corner] = {b.triangle, alike};
      of[b.triangle][b.corner] = {a.triangle, alike};
    });
  }
  std::vector<std::array<Neighbour, 3>> of;
};

Patch walk(const Neighbours& neighbours, std::uint32_t start, std::vector<char>& seen) {
  Patch patch;
  patch.triangles = {start};
  patch.against = {0};
  seen[start] = 1;
  for (std::size_t i = 0; i < patch.triangles.size(); ++i) {
    for (const Neighbour& n : neighbours.of[patch.triangles[i]]) {
      patch.closed = patch.closed && n.triangle != kNoTriangle && n.alike;
      if (n.triangle == kNoTriangle || seen[n.triangle]) continue;
      seen[n.triangle] = 1;
      patch.triangles.push_back(n.triangle);
      patch.against.push_back(static_cast<char>(patch.against[i] ^ (n.alike ? 0 : 1)));
    }
  }
  return patch;
}

}  // namespace

std::vector<Patch> patches_of(const TriMesh& mesh) {
  const Neighbours neighbours(mesh.triangles);
  std::vector<char> seen(mesh.triangles.size(), 0);
  std::vector<Patch> patches;
  for (std::uint32_t start = 0; start < seen.size(); ++start) {
    if (seen[start]) continue;
    patches.push_back(walk(neighbours, start, seen));
    for (const std::uint32_t t : patches.back().triangles)
      for (const std::uint32_t v : mesh.triangles[t]) patches.back().box.include(mesh.vertices[v]);
  }
  return patches;
}

double triangle_area(const TriMesh& mesh, std::uint32_t triangle) {
  const Triangle& t = mesh.triangles[triangle];
  const Vec3& a = mesh.vertices[t[0]];
  return (mesh.vertices[t[1]] - a).cross(mesh.vertices[t[2]] - a).norm() / 2;
}

}  // namespace osteon
