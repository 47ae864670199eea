#include "solid_part.h"

#include <algorithm>
#include <array>

#include "clip.h"
#include "osteon/mesh/measure.h"

namespace osteon::hull {
namespace {

/// What of the cells lies on the plane's side that `pick` takes. A sliver without volume vanishes.
template <class Pick>
std::vector<TriMesh> clip_cells(const std::vector<TriMesh>& cells, const Plane& plane,
                                const Pick& pick) {
  std::vector<TriMesh> out;
  for (const TriMesh& cell : cells) {
    const HullOutcome outcome = build_hull(pick(clip(cell, plane)).vertices);
    if (outcome.hull) out.push_back(to_mesh(*outcome.hull));
  }
  return out;
}

}  // namespace

std::vector<Vec3> extremes_of(const Hull& hull) {
  std::vector<Vec3> out;
  for (int x = -1; x <= 1; ++x)
    for (int y = -1; y <= 1; ++y)
      for (int z = -1; z <= 1; ++z) {
        const Vec3 n(x, y, z);
        const auto farthest =
            std::max_element(hull.vertices.begin(), hull.vertices.end(),
                             [&](const Vec3& a, const Vec3& b) { return n.dot(a) < n.dot(b); });
        if (n != Vec3::Zero()) out.push_back(*farthest);
      }
  return out;
}

TriMesh coarsened(const TriMesh& mesh, double cell_m) {
  struct Keyed {
    std::array<std::int64_t, 3> cell;
    std::uint32_t vertex;
  };
  const Aabb box = bounds(mesh);
  std::vector<Keyed> keyed;
  for (std::uint32_t v = 0; v < mesh.vertices.size(); ++v) {
    const Vec3 u = (mesh.vertices[v] - box.lo) / cell_m;
    keyed.push_back({{static_cast<std::int64_t>(u.x()), static_cast<std::int64_t>(u.y()),
                      static_cast<std::int64_t>(u.z())},
                     v});
  }
  std::sort(keyed.begin(), keyed.end(), [](const Keyed& a, const Keyed& b) {
    return a.cell != b.cell ? a.cell < b.cell : a.vertex < b.vertex;
  });
  TriMesh out;
  std::vector<std::uint32_t> of_vertex(mesh.vertices.size());
  for (std::size_t i = 0; i < keyed.size(); ++i) {
    if (i == 0 || keyed[i].cell != keyed[i - 1].cell)
      out.vertices.push_back(mesh.vertices[keyed[i].vertex]);
    of_vertex[keyed[i].vertex] = static_cast<std::uint32_t>(out.vertices.size() - 1);
  }
  for (const Triangle& t : mesh.triangles) {
    const Triangle s{of_vertex[t[0]], of_vertex[t[1]], of_vertex[t[2]]};
    if (s[0] != s[1] && s[1] != s[2] && s[2] != s[0]) out.triangles.push_back(s);
  }
  return out;
}

void append(TriMesh& to, const TriMesh& from) {
  const auto first = static_cast<std::uint32_t>(to.vertices.size());
  to.vertices.insert(to.vertices.end(), from.vertices.begin(), from.vertices.end());
  for (const Triangle& t : from.triangles)
    to.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
}

TriMesh box_mesh(const Aabb& box) {
  std::vector<Vec3> corners;
  for (const double x : {box.lo.x(), box.hi.x()})
    for (const double y : {box.lo.y(), box.hi.y()})
      for (const double z : {box.lo.z(), box.hi.z()}) corners.emplace_back(x, y, z);
  return to_mesh(*build_hull(corners).hull);
}

std::vector<TriMesh> cells_below(const std::vector<TriMesh>& cells, const Plane& plane) {
  return clip_cells(cells, plane, [](const auto& sides) -> const TriMesh& { return sides.first; });
}

std::vector<TriMesh> cells_above(const std::vector<TriMesh>& cells, const Plane& plane) {
  return clip_cells(cells, plane, [](const auto& sides) -> const TriMesh& { return sides.second; });
}

}  // namespace osteon::hull
