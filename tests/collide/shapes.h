#pragma once

// Hulls for tests, made without the hull builder.

#include <cmath>
#include <initializer_list>
#include <map>
#include <utility>
#include <vector>

#include "osteon/base/random.h"
#include "osteon/collide/convex_body.h"

namespace osteon::shapes {

inline Plane plane_through(const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 n = (b - a).cross(c - a).normalized();
  return {n, n.dot(a)};
}

/// A hull from its vertices and its facets, each a counter-clockwise polygon.
inline Hull polyhedron(std::vector<Vec3> vertices,
                       const std::vector<std::vector<std::uint32_t>>& facets) {
  Hull hull;
  hull.vertices = std::move(vertices);
  for (const auto& f : facets) {
    const auto plane = static_cast<std::uint32_t>(hull.planes.size());
    hull.planes.push_back(
        plane_through(hull.vertices[f[0]], hull.vertices[f[1]], hull.vertices[f[2]]));
    for (std::size_t k = 2; k < f.size(); ++k) {
      hull.triangles.push_back({f[0], f[k - 1], f[k]});
      hull.plane_of.push_back(plane);
    }
  }
  for (std::uint32_t i = 0; i < hull.vertices.size(); ++i) {
    hull.source.push_back(i);
    hull.centroid += hull.vertices[i] / static_cast<double>(hull.vertices.size());
  }
  return hull;
}

inline Hull box(const Vec3& half, const Vec3& center = Vec3::Zero()) {
  std::vector<Vec3> v;
  for (int i = 0; i < 8; ++i)
    v.push_back(center + Vec3((i & 1 ? 1 : -1) * half.x(), (i & 2 ? 1 : -1) * half.y(),
                              (i & 4 ? 1 : -1) * half.z()));
  return polyhedron(
      std::move(v),
      {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}});
}

inline Hull octahedron(const Vec3& half) {
  const double x = half.x(), y = half.y(), z = half.z();
  return polyhedron(
      {{x, 0, 0}, {-x, 0, 0}, {0, y, 0}, {0, -y, 0}, {0, 0, z}, {0, 0, -z}},
      {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4}, {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}});
}

/// Cone with its tip at the origin that opens along +z.
inline Hull cone(int sides, double radius, double height) {
  std::vector<Vec3> v = {Vec3::Zero()};
  std::vector<std::uint32_t> base;
  for (int i = 0; i < sides; ++i) {
    const double angle = 2 * M_PI * i / sides;
    v.emplace_back(radius * std::cos(angle), radius * std::sin(angle), height);
    base.push_back(static_cast<std::uint32_t>(i + 1));
  }
  std::vector<std::vector<std::uint32_t>> facets = {base};
  for (std::uint32_t i = 0; i < base.size(); ++i)
    facets.push_back({0, base[(i + 1) % base.size()], base[i]});
  return polyhedron(std::move(v), facets);
}

/// Convex hull of a few points in general position, by trying every triple.
inline Hull brute_force(std::vector<Vec3> points) {
  std::vector<std::vector<std::uint32_t>> facets;
  const auto n = static_cast<std::uint32_t>(points.size());
  const auto outside = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    const Vec3 normal = (points[b] - points[a]).cross(points[c] - points[a]);
    for (std::uint32_t i = 0; i < n; ++i)
      if (i != a && i != b && i != c && normal.dot(points[i] - points[a]) >= 0) return false;
    return true;
  };
  for (std::uint32_t a = 0; a < n; ++a)
    for (std::uint32_t b = a + 1; b < n; ++b)
      for (std::uint32_t c = b + 1; c < n; ++c) {
        if (outside(a, b, c)) facets.push_back({a, b, c});
        if (outside(a, c, b)) facets.push_back({a, c, b});
      }
  std::map<std::uint32_t, std::uint32_t> kept;
  std::vector<Vec3> corners;
  for (auto& f : facets)
    for (auto& v : f) {
      const auto [it, fresh] = kept.emplace(v, static_cast<std::uint32_t>(corners.size()));
      if (fresh) corners.push_back(points[v]);
      v = it->second;
    }
  return polyhedron(std::move(corners), facets);
}

/// Hull of `count` random points in an ellipsoidal shell.
inline Hull random_hull(Random& random, int count, const Vec3& half) {
  std::vector<Vec3> points;
  for (int i = 0; i < count; ++i) {
    const Vec3 direction = random.direction();
    const double share = random.uniform(0.6, 1.0);
    points.push_back(share * direction.cwiseProduct(half));
  }
  return brute_force(std::move(points));
}

/// Ellipsoid with 10 * 4^level + 2 vertices and 20 * 4^level facets.
inline Hull ellipsoid(int level, const Vec3& half) {
  const double g = (1 + std::sqrt(5.0)) / 2;
  std::vector<Vec3> v = {{-1, g, 0},  {1, g, 0},  {-1, -g, 0}, {1, -g, 0}, {0, -1, g},  {0, 1, g},
                         {0, -1, -g}, {0, 1, -g}, {g, 0, -1},  {g, 0, 1},  {-g, 0, -1}, {-g, 0, 1}};
  std::vector<std::vector<std::uint32_t>> f = {
      {0, 11, 5},  {0, 5, 1},  {0, 1, 7},  {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
      {11, 10, 2}, {10, 7, 6}, {7, 1, 8},  {3, 9, 4},  {3, 4, 2},   {3, 2, 6}, {3, 6, 8},
      {3, 8, 9},   {4, 9, 5},  {2, 4, 11}, {6, 2, 10}, {8, 6, 7},   {9, 8, 1}};
  for (int i = 0; i < level; ++i) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middles;
    const auto middle = [&](std::uint32_t a, std::uint32_t b) {
      const auto [it, fresh] =
          middles.emplace(std::minmax(a, b), static_cast<std::uint32_t>(v.size()));
      if (fresh) v.push_back(v[a].normalized() + v[b].normalized());
      return it->second;
    };
    std::vector<std::vector<std::uint32_t>> finer;
    for (const auto& t : f) {
      const std::uint32_t ab = middle(t[0], t[1]);
      const std::uint32_t bc = middle(t[1], t[2]);
      const std::uint32_t ca = middle(t[2], t[0]);
      finer.insert(finer.end(), {{t[0], ab, ca}, {t[1], bc, ab}, {t[2], ca, bc}, {ab, bc, ca}});
    }
    f = std::move(finer);
  }
  for (Vec3& p : v) p = p.normalized().cwiseProduct(half);
  return polyhedron(std::move(v), f);
}

inline ConvexBody body(const Hull& hull) { return make_convex_body(hull); }

inline Pose random_pose(Random& random, double reach) {
  const Vec3 direction = random.direction();
  const double distance = random.uniform(0, reach);
  const Quat turn = random.rotation();
  return {distance * direction, turn};
}

}  // namespace osteon::shapes
