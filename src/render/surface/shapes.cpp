#include "surface/shapes.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <numeric>
#include <utility>

#include "surface/surface.h"

namespace osteon {
namespace {

constexpr double kCreaseCosine = 0.766;  // 40 degrees
constexpr ShadedMesh::Shade kNoShade{255, 128, 128, 0};

std::array<float, 3> corner_floats(const Vec3& v) {
  return {static_cast<float>(v.x()), static_cast<float>(v.y()), static_cast<float>(v.z())};
}

void add_corner(ShadedMesh& mesh, const Vec3& p, const Vec3& n) {
  mesh.positions.push_back(corner_floats(p));
  mesh.normals.push_back(corner_floats(n));
  mesh.shades.push_back(kNoShade);
}

void add_triangle(ShadedMesh& mesh, const std::array<Vec3, 3>& p, const std::array<Vec3, 3>& n) {
  const auto base = static_cast<std::uint32_t>(mesh.positions.size());
  for (std::size_t k = 0; k < 3; ++k) add_corner(mesh, p[k], n[k]);
  mesh.triangles.push_back({base, base + 1, base + 2});
}

Vec3 unit_normal(const Surface& s, const Triangle& t) {
  const Vec3 n = (s.points[t[1]] - s.points[t[0]]).cross(s.points[t[2]] - s.points[t[0]]);
  const double length = n.norm();
  return length > 0 ? Vec3(n / length) : Vec3::UnitZ();
}

/// Triangles at point k, in their order: triangles[first[k]] up to triangles[first[k + 1]].
struct Around {
  std::vector<std::uint32_t> first, triangles;
};

Around triangles_around(const Surface& s) {
  Around out;
  out.first.assign(s.points.size() + 1, 0);
  for (const Triangle& t : s.triangles)
    for (const std::uint32_t v : t) ++out.first[v + 1];
  std::partial_sum(out.first.begin(), out.first.end(), out.first.begin());
  out.triangles.resize(3 * s.triangles.size());
  std::vector<std::uint32_t> next = out.first;
  for (std::uint32_t i = 0; i < s.triangles.size(); ++i)
    for (const std::uint32_t v : s.triangles[i]) out.triangles[next[v]++] = i;
  return out;
}

Vec3 on_circle(int k, int sides, double z) {
  const double angle = 2 * std::numbers::pi * k / sides;
  return {std::cos(angle), std::sin(angle), z};
}

/// Index pairs of a ring of `sides` corners that starts at `first`.
std::pair<std::uint32_t, std::uint32_t> ring_edge(std::uint32_t first, int k, int sides) {
  return {first + static_cast<std::uint32_t>(k),
          first + static_cast<std::uint32_t>((k + 1) % sides)};
}

}  // namespace

ShadedMesh plain_shaded(const TriMesh& mesh) {
  const Surface s = welded(mesh);
  std::vector<Vec3> normals;
  normals.reserve(s.triangles.size());
  for (const Triangle& t : s.triangles) normals.push_back(unit_normal(s, t));
  const Around around = triangles_around(s);
  ShadedMesh out;
  out.positions.reserve(3 * s.triangles.size());
  out.normals.reserve(3 * s.triangles.size());
  out.shades.reserve(3 * s.triangles.size());
  out.triangles.reserve(s.triangles.size());
  for (std::size_t i = 0; i < s.triangles.size(); ++i) {
    const Triangle& t = s.triangles[i];
    const Vec3& own = normals[i];
    std::array<Vec3, 3> p, n;
    for (std::size_t k = 0; k < 3; ++k) {
      Vec3 sum = Vec3::Zero();
      for (std::uint32_t e = around.first[t[k]]; e < around.first[t[k] + 1]; ++e)
        if (const Vec3& other = normals[around.triangles[e]]; other.dot(own) > kCreaseCosine)
          sum += other;
      p[k] = s.points[t[k]];
      n[k] = sum.norm() > 0 ? Vec3(sum.normalized()) : own;
    }
    add_triangle(out, p, n);
  }
  return out;
}

ShadedMesh faceted(std::span<const Hull> hulls) {
  ShadedMesh out;
  for (const Hull& hull : hulls) {
    for (std::size_t k = 0; k < hull.triangles.size(); ++k) {
      const Triangle& t = hull.triangles[k];
      const Vec3& n = hull.planes[hull.plane_of[k]].n;
      add_triangle(out, {hull.vertices[t[0]], hull.vertices[t[1]], hull.vertices[t[2]]}, {n, n, n});
    }
  }
  return out;
}

std::vector<std::array<float, 3>> facet_edges(std::span<const Hull> hulls) {
  std::vector<std::array<float, 3>> ends;
  for (const Hull& hull : hulls) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> facet_of_edge;
    for (std::size_t k = 0; k < hull.triangles.size(); ++k) {
      const Triangle& t = hull.triangles[k];
      for (std::size_t e = 0; e < 3; ++e) {
        const std::uint32_t a = t[e], b = t[(e + 1) % 3];
        const auto other = facet_of_edge.find({b, a});
        if (other == facet_of_edge.end()) {
          facet_of_edge[{a, b}] = hull.plane_of[k];
        } else if (other->second != hull.plane_of[k]) {
          ends.push_back(corner_floats(hull.vertices[a]));
          ends.push_back(corner_floats(hull.vertices[b]));
        }
      }
    }
  }
  return ends;
}

TriMesh cylinder(int sides) {
  TriMesh mesh;
  const auto n = static_cast<std::uint32_t>(sides);
  for (const double z : {0.0, 1.0})
    for (int k = 0; k < sides; ++k) mesh.vertices.push_back(on_circle(k, sides, z));
  mesh.vertices.emplace_back(0, 0, 0);
  mesh.vertices.emplace_back(0, 0, 1);
  for (int k = 0; k < sides; ++k) {
    const auto [a, b] = ring_edge(0, k, sides);
    mesh.triangles.push_back({a, b, b + n});
    mesh.triangles.push_back({a, b + n, a + n});
    mesh.triangles.push_back({2 * n, b, a});
    mesh.triangles.push_back({2 * n + 1, a + n, b + n});
  }
  return mesh;
}

TriMesh cone(int sides) {
  TriMesh mesh;
  const auto n = static_cast<std::uint32_t>(sides);
  for (int k = 0; k < sides; ++k) mesh.vertices.push_back(on_circle(k, sides, 0));
  mesh.vertices.emplace_back(0, 0, 0);
  mesh.vertices.emplace_back(0, 0, 1);
  for (int k = 0; k < sides; ++k) {
    const auto [a, b] = ring_edge(0, k, sides);
    mesh.triangles.push_back({a, b, n + 1});
    mesh.triangles.push_back({n, b, a});
  }
  return mesh;
}

TriMesh ball(int rings, int sides) {
  TriMesh mesh;
  for (int r = 1; r < rings; ++r) {
    const double polar = std::numbers::pi * r / rings;
    for (int k = 0; k < sides; ++k) {
      const Vec3 c = on_circle(k, sides, 0) * std::sin(polar);
      mesh.vertices.emplace_back(c.x(), c.y(), std::cos(polar));
    }
  }
  const auto n = static_cast<std::uint32_t>(sides);
  const auto north = static_cast<std::uint32_t>(mesh.vertices.size()), south = north + 1;
  mesh.vertices.emplace_back(0, 0, 1);
  mesh.vertices.emplace_back(0, 0, -1);
  for (int k = 0; k < sides; ++k) {
    const auto [a, b] = ring_edge(0, k, sides);
    mesh.triangles.push_back({north, a, b});
    for (std::uint32_t r = 0; r + 2 < static_cast<std::uint32_t>(rings); ++r) {
      mesh.triangles.push_back({a + r * n, a + (r + 1) * n, b + (r + 1) * n});
      mesh.triangles.push_back({a + r * n, b + (r + 1) * n, b + r * n});
    }
    const std::uint32_t last = (static_cast<std::uint32_t>(rings) - 2) * n;
    mesh.triangles.push_back({south, b + last, a + last});
  }
  return mesh;
}

}  // namespace osteon
