#include "instrument/loop_stack.h"

#include <cassert>

namespace osteon {
namespace {

using Index = std::uint32_t;

void join_loops(TriMesh& mesh, Index from, Index to, Index segments) {
  for (Index i = 0; i < segments; ++i) {
    const Index j = i + 1 == segments ? 0 : i + 1;
    mesh.triangles.push_back({from + i, from + j, to + j});
    mesh.triangles.push_back({from + i, to + j, to + i});
  }
}

void close_end(TriMesh& mesh, Index point, Index loop, Index segments, bool at_start) {
  for (Index i = 0; i < segments; ++i) {
    const Index j = i + 1 == segments ? 0 : i + 1;
    if (at_start) {
      mesh.triangles.push_back({point, loop + j, loop + i});
    } else {
      mesh.triangles.push_back({point, loop + i, loop + j});
    }
  }
}

void add_loops(TriMesh& mesh, std::span<const Loop> loops) {
  for (const Loop& loop : loops)
    mesh.vertices.insert(mesh.vertices.end(), loop.begin(), loop.end());
}

}  // namespace

TriMesh stack_loops(const Vec3& first_point, std::span<const Loop> loops, const Vec3& last_point) {
  assert(!loops.empty() && loops.front().size() >= 3);
  TriMesh mesh;
  const auto n = static_cast<Index>(loops.front().size());
  mesh.vertices.push_back(first_point);
  add_loops(mesh, loops);
  mesh.vertices.push_back(last_point);
  close_end(mesh, 0, 1, n, true);
  for (Index r = 0; r + 1 < loops.size(); ++r) join_loops(mesh, 1 + r * n, 1 + (r + 1) * n, n);
  const auto last = static_cast<Index>(mesh.vertices.size() - 1);
  close_end(mesh, last, last - n, n, false);
  return mesh;
}

TriMesh ring_of_loops(std::span<const Loop> loops) {
  assert(loops.size() >= 3 && loops.front().size() >= 3);
  TriMesh mesh;
  const auto n = static_cast<Index>(loops.front().size());
  const auto count = static_cast<Index>(loops.size());
  add_loops(mesh, loops);
  for (Index r = 0; r < count; ++r) join_loops(mesh, r * n, (r + 1 == count ? 0 : r + 1) * n, n);
  return mesh;
}

}  // namespace osteon
