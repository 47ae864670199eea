#pragma once

#include <cstdlib>
#include <filesystem>
#include <string>

#include "osteon/mesh/tri_mesh.h"

namespace osteon::test {

/// Closed, outward cube of edge 2 h about c: 8 vertices, 12 triangles.
inline TriMesh cube(double h = 0.5, const Vec3& c = Vec3::Zero()) {
  TriMesh m;
  for (int i = 0; i < 8; ++i)
    m.vertices.push_back(c + h * Vec3(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1));
  m.triangles = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                 {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
  return m;
}

/// Closed, outward sphere with `rings` x 2 `rings` patches.
inline TriMesh sphere(double r, std::uint32_t rings, const Vec3& c = Vec3::Zero()) {
  TriMesh m;
  const std::uint32_t around = 2 * rings;
  m.vertices.push_back(c + Vec3(0, 0, r));
  for (std::uint32_t i = 1; i < rings; ++i) {
    for (std::uint32_t j = 0; j < around; ++j) {
      const double theta = M_PI * i / rings, phi = 2 * M_PI * j / around;
      m.vertices.push_back(c + r * Vec3(std::sin(theta) * std::cos(phi),
                                        std::sin(theta) * std::sin(phi), std::cos(theta)));
    }
  }
  m.vertices.push_back(c - Vec3(0, 0, r));
  const auto at = [around](std::uint32_t i, std::uint32_t j) {
    return 1 + (i - 1) * around + j % around;
  };
  const auto south = static_cast<std::uint32_t>(m.vertices.size() - 1);
  for (std::uint32_t j = 0; j < around; ++j) {
    m.triangles.push_back({0, at(1, j), at(1, j + 1)});
    for (std::uint32_t i = 1; i + 1 < rings; ++i) {
      m.triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      m.triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
    m.triangles.push_back({south, at(rings - 1, j + 1), at(rings - 1, j)});
  }
  return m;
}

/// Three vertices of its own for every triangle, as STL stores a mesh.
inline TriMesh soup(const TriMesh& m) {
  TriMesh out;
  for (const Triangle& t : m.triangles) {
    const auto first = static_cast<std::uint32_t>(out.vertices.size());
    for (const std::uint32_t v : t) out.vertices.push_back(m.vertices[v]);
    out.triangles.push_back({first, first + 1, first + 2});
  }
  return out;
}

inline TriMesh joined(const TriMesh& a, const TriMesh& b) {
  TriMesh out = a;
  const auto first = static_cast<std::uint32_t>(a.vertices.size());
  out.vertices.insert(out.vertices.end(), b.vertices.begin(), b.vertices.end());
  for (const Triangle& t : b.triangles)
    out.triangles.push_back({first + t[0], first + t[1], first + t[2]});
  return out;
}

inline void flip(Triangle& t) { std::swap(t[1], t[2]); }

/// Empty folder of one test.
inline std::filesystem::path fresh_folder(const std::string& name) {
  const std::filesystem::path dir = std::filesystem::path(OSTEON_BINARY_DIR) / "test-files" / name;
  std::filesystem::remove_all(dir);
  std::filesystem::create_directories(dir);
  return dir;
}

/// The folder of reference data, which is not part of the repository; may not exist.
inline std::filesystem::path shared_folder() {
  if (const char* set = std::getenv("OSTEON_SHARED"); set && *set) return set;
  return std::filesystem::path(OSTEON_SOURCE_DIR) / "../shared";
}

}  // namespace osteon::test
