#pragma once

#include <cstdint>
#include <span>

#include "osteon/base/hash.h"
#include "osteon/mesh/tri_mesh.h"

namespace osteon {

inline void add_points(Hasher& hasher, std::span<const Vec3> points) {
  hasher.add(static_cast<std::uint64_t>(points.size()));
  for (const Vec3& p : points) hasher.add(p);
}

inline void add_triangles(Hasher& hasher, std::span<const Triangle> triangles) {
  hasher.add(static_cast<std::uint64_t>(triangles.size()));
  for (const Triangle& t : triangles)
    for (const std::uint32_t v : t) hasher.add(v);
}

inline void add_mesh(Hasher& hasher, const TriMesh& mesh) {
  add_points(hasher, mesh.vertices);
  add_triangles(hasher, mesh.triangles);
}

}  // namespace osteon
