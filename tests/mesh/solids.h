#pragma once

#include <cmath>
#include <cstdint>
#include <vector>

#include "osteon/mesh/tri_mesh.h"

namespace osteon::test {

/// A point of a profile: distance from the z axis and height.
struct ProfilePoint {
  double r = 0, z = 0;
};

/// Closed, outward solid of revolution: the profile, which runs counter-clockwise in (r, z), is
/// turned about z. All radii must be positive.
inline TriMesh revolved(const std::vector<ProfilePoint>& profile, std::uint32_t around) {
  TriMesh m;
  const auto n = static_cast<std::uint32_t>(profile.size());
  for (std::uint32_t j = 0; j < around; ++j)
    for (const ProfilePoint& p : profile) {
      const double phi = 2 * M_PI * j / around;
      m.vertices.push_back(Vec3(p.r * std::cos(phi), p.r * std::sin(phi), p.z));
    }
  for (std::uint32_t j = 0; j < around; ++j)
    for (std::uint32_t i = 0; i < n; ++i) {
      const std::uint32_t a = j * n + i, b = j * n + (i + 1) % n;
      const std::uint32_t c = (j + 1) % around * n + i, d = (j + 1) % around * n + (i + 1) % n;
      m.triangles.push_back({a, c, d});
      m.triangles.push_back({a, d, b});
    }
  return m;
}

inline TriMesh torus(double large, double small, std::uint32_t around, std::uint32_t across) {
  std::vector<ProfilePoint> profile;
  for (std::uint32_t i = 0; i < across; ++i) {
    const double theta = 2 * M_PI * i / across;
    profile.push_back({large + small * std::cos(theta), small * std::sin(theta)});
  }
  return revolved(profile, around);
}

/// A square of edge `width` turned about z at a distance of `radius` from it to its inner side.
inline TriMesh flat_ring(double radius, double width, double height, std::uint32_t around) {
  return revolved({{radius, -0.5 * height},
                   {radius + width, -0.5 * height},
                   {radius + width, 0.5 * height},
                   {radius, 0.5 * height}},
                  around);
}

/// Box with these edges, turned so that none lies along a lattice.
inline TriMesh turned_box(const Vec3& edges) {
  TriMesh m;
  const Quat turn = Quat(0.8, 0.3, -0.4, 0.2).normalized();
  for (int i = 0; i < 8; ++i)
    m.vertices.push_back(turn * Vec3(0.5 * edges.cwiseProduct(Vec3(i & 1 ? 1 : -1, i & 2 ? 1 : -1,
                                                                   i & 4 ? 1 : -1))));
  m.triangles = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                 {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
  return m;
}

}  // namespace osteon::test
