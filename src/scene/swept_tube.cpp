#include "swept_tube.h"

#include <cassert>
#include <cmath>
#include <numbers>

namespace osteon {
namespace {

using Index = std::uint32_t;

void add_ring(TriMesh& mesh, const TubeRing& ring, int segments) {
  const Vec3 side = Vec3::UnitY();
  const Vec3 up = ring.along.cross(side);
  for (int i = 0; i < segments; ++i) {
    const double a = 2 * std::numbers::pi * i / segments;
    mesh.vertices.push_back(ring.center + ring.radius_m * (std::cos(a) * side + std::sin(a) * up));
  }
}

// From `side` to `along x side` the ring runs counter-clockwise seen against `along`.
void join_rings(TriMesh& mesh, Index from, Index to, Index segments) {
  for (Index i = 0; i < segments; ++i) {
    const Index j = i + 1 == segments ? 0 : i + 1;
    mesh.triangles.push_back({from + i, from + j, to + j});
    mesh.triangles.push_back({from + i, to + j, to + i});
  }
}

void close_end(TriMesh& mesh, Index point, Index ring, Index segments, bool at_start) {
  for (Index i = 0; i < segments; ++i) {
    const Index j = i + 1 == segments ? 0 : i + 1;
    if (at_start) {
      mesh.triangles.push_back({point, ring + j, ring + i});
    } else {
      mesh.triangles.push_back({point, ring + i, ring + j});
    }
  }
}

}  // namespace

TriMesh sweep_tube(const Vec3& first_point, const std::vector<TubeRing>& rings,
                   const Vec3& last_point, int segments) {
  assert(!rings.empty() && segments >= 3);
  TriMesh mesh;
  const auto n = static_cast<Index>(segments);
  mesh.vertices.push_back(first_point);
  for (const TubeRing& ring : rings) add_ring(mesh, ring, segments);
  mesh.vertices.push_back(last_point);

  close_end(mesh, 0, 1, n, true);
  for (Index r = 0; r + 1 < rings.size(); ++r) join_rings(mesh, 1 + r * n, 1 + (r + 1) * n, n);
  const auto last = static_cast<Index>(mesh.vertices.size() - 1);
  close_end(mesh, last, last - n, n, false);
  return mesh;
}

}  // namespace osteon
