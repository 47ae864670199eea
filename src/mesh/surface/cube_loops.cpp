#include "osteon/mesh/cube_loops.h"

namespace osteon {
namespace {

struct CubeFace {
  std::array<int, 4> corners;  ///< around the face
  std::array<int, 4> edges;    ///< edge k joins corners k and k + 1
};

CubeFace cube_face(int face) {
  const int axis = face / 2, side = face % 2;
  const int u = (axis + 1) % 3, v = (axis + 2) % 3;
  const int base = side << axis;
  // Along u the next axis is v; along v the next axis is `axis`, then u.
  return {{base, base | 1 << u, base | 1 << u | 1 << v, base | 1 << v},
          {4 * u + 2 * side, 4 * v + side + 2, 4 * u + 1 + 2 * side, 4 * v + side}};
}

bool is_inside(std::uint8_t inside, int corner) { return (inside >> corner & 1) != 0; }

/// Smallest edge of the set that `edge` belongs to.
int root(const std::array<int, 12>& parent, int edge) {
  while (parent[static_cast<std::size_t>(edge)] != edge)
    edge = parent[static_cast<std::size_t>(edge)];
  return edge;
}

void join(std::array<int, 12>& parent, int a, int b) {
  const int ra = root(parent, a), rb = root(parent, b);
  parent[static_cast<std::size_t>(ra > rb ? ra : rb)] = ra > rb ? rb : ra;
}

void join_edges_of_face(std::uint8_t inside, const CubeFace& f, bool joined,
                        std::array<int, 12>& parent) {
  int crossed[4], n = 0;
  for (std::size_t k = 0; k < 4; ++k)
    if (is_inside(inside, f.corners[k]) != is_inside(inside, f.corners[(k + 1) % 4]))
      crossed[n++] = f.edges[k];
  if (n == 2) join(parent, crossed[0], crossed[1]);
  if (n != 4) return;
  // Pair the two edges that meet in each corner which the surface cuts off.
  const std::size_t first = is_inside(inside, f.corners[0]) != joined ? 0 : 1;
  for (std::size_t k = first; k < 4; k += 2) join(parent, f.edges[(k + 3) % 4], f.edges[k]);
}

}  // namespace

std::pair<int, int> cube_edge_corners(int edge) {
  const int axis = edge / 4;
  const int corner = (edge & 1) << (axis + 1) % 3 | (edge >> 1 & 1) << (axis + 2) % 3;
  return {corner, corner | 1 << axis};
}

CubeLoops cube_loops(std::uint8_t inside, std::uint8_t joined_faces) {
  std::array<int, 12> parent{};
  for (int e = 0; e < 12; ++e) parent[static_cast<std::size_t>(e)] = e;
  for (int f = 0; f < 6; ++f)
    join_edges_of_face(inside, cube_face(f), (joined_faces >> f & 1) != 0, parent);
  CubeLoops loops;
  loops.of_edge.fill(-1);
  for (int e = 0; e < 12; ++e) {
    const auto [a, b] = cube_edge_corners(e);
    if (is_inside(inside, a) == is_inside(inside, b)) continue;
    const int r = root(parent, e);
    loops.of_edge[static_cast<std::size_t>(e)] = r == e
                                                     ? static_cast<std::int8_t>(loops.count++)
                                                     : loops.of_edge[static_cast<std::size_t>(r)];
  }
  return loops;
}

bool face_is_ambiguous(std::uint8_t inside, int face) {
  const CubeFace f = cube_face(face);
  const bool a = is_inside(inside, f.corners[0]);
  return is_inside(inside, f.corners[1]) != a && is_inside(inside, f.corners[2]) == a &&
         is_inside(inside, f.corners[3]) != a;
}

bool one_loop_takes_face(const CubeLoops& loops, int face) {
  const CubeFace f = cube_face(face);
  const auto loop = loops.of_edge[static_cast<std::size_t>(f.edges[0])];
  for (const int e : f.edges)
    if (loops.of_edge[static_cast<std::size_t>(e)] != loop) return false;
  return true;
}

}  // namespace osteon
