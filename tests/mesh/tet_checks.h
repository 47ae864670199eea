#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "osteon/base/hash.h"
#include "osteon/mesh/tet_mesh.h"

// Checks of tetrahedral meshes, written apart from the code that makes them.
namespace osteon::checks {

inline double determinant(const TetMesh& mesh, const Tetrahedron& t) {
  Mat3 m;
  for (Mat3::Index k = 0; k < 3; ++k)
    m.col(k) = mesh.vertices[t[static_cast<std::size_t>(k) + 1]] - mesh.vertices[t[0]];
  return m.determinant();
}

inline bool all_upright(const TetMesh& mesh) {
  return !mesh.tets.empty() &&
         std::all_of(mesh.tets.begin(), mesh.tets.end(),
                     [&](const Tetrahedron& t) { return determinant(mesh, t) > 0; });
}

/// Every triangle belongs to at most two elements.
inline bool faces_fit(const TetMesh& mesh) {
  std::map<std::array<std::uint32_t, 3>, int> uses;
  for (const Tetrahedron& t : mesh.tets)
    for (std::size_t skip = 0; skip < 4; ++skip) {
      std::array<std::uint32_t, 3> face{t[(skip + 1) % 4], t[(skip + 2) % 4], t[(skip + 3) % 4]};
      std::sort(face.begin(), face.end());
      if (++uses[face] > 2) return false;
    }
  return true;
}

/// Smallest and largest angle between two faces, degrees, from the faces' normals.
inline std::pair<double, double> dihedral_range_deg(const TetMesh& mesh) {
  double least = 180, most = 0;
  for (const Tetrahedron& t : mesh.tets)
    for (std::size_t i = 0; i < 4; ++i)
      for (std::size_t j = 0; j < i; ++j) {
        std::array<Vec3, 2> n;
        const std::array<std::size_t, 2> opposite{i, j};
        for (std::size_t f = 0; f < 2; ++f) {
          const std::size_t o = opposite[f];
          const Vec3 &a = mesh.vertices[t[(o + 1) % 4]], &b = mesh.vertices[t[(o + 2) % 4]],
                     &c = mesh.vertices[t[(o + 3) % 4]];
          n[f] = (b - a).cross(c - a).normalized();
          if (n[f].dot(mesh.vertices[t[o]] - a) > 0) n[f] = -n[f];
        }
        const double angle = 180 - std::acos(std::clamp(n[0].dot(n[1]), -1.0, 1.0)) * 180 / M_PI;
        least = std::min(least, angle);
        most = std::max(most, angle);
      }
  return {least, most};
}

inline std::uint64_t hash_of(const TetMesh& mesh) {
  Hasher h;
  for (const Vec3& v : mesh.vertices) h.add(v);
  for (const Tetrahedron& t : mesh.tets)
    for (const std::uint32_t i : t) h.add(i);
  return h.value();
}

}  // namespace osteon::checks
