#include "osteon/mesh/measure.h"

#include <algorithm>
#include <cmath>

#include "repair/edges.h"

namespace osteon {
namespace {

Vec3 doubled_area_normal(const TriMesh& mesh, const Triangle& t) {
  const Vec3& a = mesh.vertices[t[0]];
  return (mesh.vertices[t[1]] - a).cross(mesh.vertices[t[2]] - a);
}

struct Moments {
  double six_volumes = 0;
  Vec3 first = Vec3::Zero();  ///< 24 times the first moment of volume about the origin given
};

// Divergence theorem: signed tetrahedra from `o` to every triangle.
Moments moments_about(const TriMesh& mesh, const Vec3& o) {
  Moments sum;
  for (const Triangle& t : mesh.triangles) {
    const Vec3 a = mesh.vertices[t[0]] - o;
    const Vec3 b = mesh.vertices[t[1]] - o;
    const Vec3 c = mesh.vertices[t[2]] - o;
    const double six = a.dot(b.cross(c));
    sum.six_volumes += six;
    sum.first += six * (a + b + c);
  }
  return sum;
}

}  // namespace

Aabb bounds(const TriMesh& mesh) {
  Aabb box;
  for (const Vec3& v : mesh.vertices) box.include(v);
  return box;
}

double volume(const TriMesh& mesh) {
  if (mesh.triangles.empty()) return 0;
  // About a point amid the mesh: far from it the terms would cancel.
  return moments_about(mesh, bounds(mesh).center()).six_volumes / 6;
}

double area(const TriMesh& mesh) {
  double sum = 0;
  for (const Triangle& t : mesh.triangles) sum += doubled_area_normal(mesh, t).norm();
  return sum / 2;
}

Vec3 centroid(const TriMesh& mesh) {
  const Aabb box = bounds(mesh);
  if (box.empty()) return Vec3::Zero();
  const Vec3 o = box.center();
  const Moments sum = moments_about(mesh, o);
  if (std::abs(sum.six_volumes) <= 1e-9 * box.extent().prod()) return o;
  const Vec3 c = o + sum.first / (4 * sum.six_volumes);
  // The centre of an open or half inside-out surface may come to lie anywhere.
  const bool inside = (c.array() >= box.lo.array()).all() && (c.array() <= box.hi.array()).all();
  return inside ? c : o;
}

std::vector<Vec3> vertex_normals(const TriMesh& mesh) {
  std::vector<Vec3> normals(mesh.vertices.size(), Vec3::Zero());
  for (const Triangle& t : mesh.triangles) {
    const Vec3 n = doubled_area_normal(mesh, t);
    for (const std::uint32_t v : t) normals[v] += n;
  }
  for (Vec3& n : normals) {
    const double length = n.norm();
    n = length > 0 ? Vec3(n / length) : Vec3(Vec3::UnitZ());
  }
  return normals;
}

Topology topology(const TriMesh& mesh) {
  Topology found;
  const std::vector<EdgeUse> uses = edge_uses(mesh.triangles);
  for_each_edge(uses, [&found](auto first, auto last) {
    const auto count = last - first;
    if (count == 1) ++found.boundary_edges;
    if (count > 2) ++found.non_manifold_edges;
    if (count == 2 && first->ascending == (first + 1)->ascending) ++found.misoriented_edges;
  });
  for (const std::uint32_t c : triangle_components(mesh.triangles, uses))
    found.components = std::max<std::size_t>(found.components, c + 1);
  return found;
}

std::vector<TriMesh> connected_parts(const TriMesh& mesh) {
  constexpr std::uint32_t kNone = 0xffffffffu;
  const auto component = triangle_components(mesh.triangles, edge_uses(mesh.triangles));
  std::vector<std::vector<std::uint32_t>> members;
  for (std::uint32_t t = 0; t < component.size(); ++t) {
    if (component[t] == members.size()) members.emplace_back();
    members[component[t]].push_back(t);
  }
  std::vector<TriMesh> parts;
  std::vector<std::uint32_t> place(mesh.vertices.size(), kNone);
  for (const auto& triangles : members) {
    TriMesh& part = parts.emplace_back();
    for (const std::uint32_t t : triangles) {
      Triangle& triangle = part.triangles.emplace_back(mesh.triangles[t]);
      for (std::uint32_t& corner : triangle) {
        std::uint32_t& at = place[corner];
        if (at == kNone) {
          at = static_cast<std::uint32_t>(part.vertices.size());
          part.vertices.push_back(mesh.vertices[corner]);
        }
        corner = at;
      }
    }
    for (const std::uint32_t t : triangles)
      for (const std::uint32_t corner : mesh.triangles[t]) place[corner] = kNone;
  }
  return parts;
}

}  // namespace osteon
