#pragma once

#include <cstdint>
#include <map>
#include <utility>

#include "osteon/base/hash.h"
#include "osteon/mesh/tri_mesh.h"

// Checks of closed surfaces, written apart from the code that makes them.
namespace osteon::checks {

/// Every edge is run once each way: closed, oriented, at most two triangles an edge.
inline bool is_closed_manifold(const TriMesh& mesh) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> runs;
  for (const Triangle& t : mesh.triangles)
    for (std::size_t k = 0; k < 3; ++k) ++runs[{t[k], t[(k + 1) % 3]}];
  for (const auto& [edge, count] : runs) {
    if (edge.first == edge.second || count != 1) return false;
    if (!runs.contains({edge.second, edge.first})) return false;
  }
  return !mesh.triangles.empty();
}

/// Every vertex's triangles form one fan.
inline bool has_single_fans(const TriMesh& mesh) {
  std::map<std::uint32_t, std::map<std::uint32_t, std::uint32_t>> rims;
  for (const Triangle& t : mesh.triangles)
    for (std::size_t k = 0; k < 3; ++k) rims[t[k]][t[(k + 1) % 3]] = t[(k + 2) % 3];
  for (const auto& [vertex, rim] : rims) {
    std::size_t steps = 0;
    const std::uint32_t first = rim.begin()->first;
    for (std::uint32_t at = first; steps == 0 || at != first; ++steps) {
      const auto next = rim.find(at);
      if (next == rim.end() || steps > rim.size()) return false;
      at = next->second;
    }
    if (steps != rim.size()) return false;
  }
  return rims.size() == mesh.vertices.size();
}

inline double signed_volume(const TriMesh& mesh) {
  double six = 0;
  for (const Triangle& t : mesh.triangles)
    six += mesh.vertices[t[0]].dot(mesh.vertices[t[1]].cross(mesh.vertices[t[2]]));
  return six / 6;
}

/// V - E + F: two for each piece without handles.
inline long euler_number(const TriMesh& mesh) {
  const auto triangles = static_cast<long>(mesh.triangles.size());
  return static_cast<long>(mesh.vertices.size()) - triangles * 3 / 2 + triangles;
}

inline std::uint64_t hash_of(const TriMesh& mesh) {
  Hasher h;
  for (const Vec3& v : mesh.vertices) h.add(v);
  for (const Triangle& t : mesh.triangles)
    for (const std::uint32_t i : t) h.add(i);
  return h.value();
}

}  // namespace osteon::checks
