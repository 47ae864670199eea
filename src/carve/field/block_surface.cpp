#include "field/block_surface.h"

#include "field/cell_vertex.h"
#include "field/edge_crossing.h"
#include "osteon/mesh/cube_loops.h"

namespace osteon {
namespace {

constexpr int kSide = BlockGrid::kSide;
constexpr std::size_t kMostLoops = 4;

int corner_node(int corner) {
  return NodeWindow::index(corner & 1, corner >> 1 & 1, corner >> 2) - NodeWindow::index(0, 0, 0);
}

/// Loops of every cube, as it is and with one face joined: no cube has two faces that one loop
/// takes twice (all 256 were looked at, see the test), so more is never needed.
struct LoopTable {
  LoopTable() {
    for (std::size_t m = 0; m < 256; ++m) {
      const auto mask = static_cast<std::uint8_t>(m);
      plain[m] = cube_loops(mask, 0);
      for (int f = 0; f < 6; ++f) {
        if (!face_is_ambiguous(mask, f) || !one_loop_takes_face(plain[m], f)) continue;
        bad_face[m] = static_cast<std::int8_t>(f);
        joined[m] = cube_loops(mask, static_cast<std::uint8_t>(1 << f));
      }
    }
  }
  std::array<CubeLoops, 256> plain{}, joined{};
  std::array<std::int8_t, 256> bad_face = [] {
    std::array<std::int8_t, 256> none{};
    none.fill(-1);
    return none;
  }();
};

const LoopTable& loop_table() {
  static const LoopTable table;
  return table;
}

struct Cell {
  int i, j, k;  // of its lowest corner, from -1 to 7 in the patch
};

class PatchMaker {
 public:
  PatchMaker(const NodeWindow& window, const BlockGrid& grid, const std::array<int, 3>& block,
             SurfacePatch& out)
      : window_(window), grid_(grid), block_(block), out_(out) {}

  void run() {
    out_.clear();
    for (int n = 0; n < static_cast<int>(NodeWindow::kCount); ++n)
      left_[static_cast<std::size_t>(n)] = window_.left(n) ? 1 : 0;
    if (!crossed()) return;
    vertex_.fill(kNone);
    crossing_.fill(kNone);
    for (int k = 0; k < kSide; ++k)
      for (int j = 0; j < kSide; ++j)
        for (int i = 0; i < kSide; ++i) edges_from(i, j, k);
  }

 private:
  static constexpr std::uint16_t kNone = 0xffff;

  bool is_left(int node) const { return left_[static_cast<std::size_t>(node)] != 0; }

  /// Whether any edge that starts at a node of the block crosses the surface.
  bool crossed() const {
    int any = 0, all = 1;
    for (int k = 0; k <= kSide; ++k)
      for (int j = 0; j <= kSide; ++j)
        for (int i = 0; i <= kSide; ++i) {
          const int here = left_[static_cast<std::size_t>(NodeWindow::index(i, j, k))];
          any |= here;
          all &= here;
        }
    return any != all;
  }

  static constexpr std::array<int, 3> kStride{1, NodeWindow::kSpan,
                                              NodeWindow::kSpan* NodeWindow::kSpan};

  /// Each crossed edge is ringed by four cells, whose vertices make a quad.
  void edges_from(int i, int j, int k) {
    const int node = NodeWindow::index(i, j, k);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const bool from_left = is_left(node);
      if (from_left == is_left(node + kStride[axis])) continue;
      std::array<std::uint32_t, 4> quad{};
      for (std::size_t n = 0; n < 4; ++n) {
        const int du = (n == 0 || n == 3) ? 1 : 0, dv = n < 2 ? 1 : 0;
        std::array<int, 3> at{i, j, k};
        at[(axis + 1) % 3] -= du;
        at[(axis + 2) % 3] -= dv;
        quad[n] = vertex({at[0], at[1], at[2]}, 4 * static_cast<int>(axis) + du + 2 * dv);
      }
      if (!from_left) std::swap(quad[1], quad[3]);
      add_quad(quad);
    }
  }

  /// Along a rim where one runs from corner to corner, else along the shorter diagonal.
  void add_quad(const std::array<std::uint32_t, 4>& q) {
    const auto& v = out_.vertices;
    const bool rim02 = on_rim_[q[0]] && on_rim_[q[2]], rim13 = on_rim_[q[1]] && on_rim_[q[3]];
    const bool shorter = (v[q[0]] - v[q[2]]).squaredNorm() <= (v[q[1]] - v[q[3]]).squaredNorm();
    if (rim02 != rim13 ? rim02 : shorter) {
      out_.triangles.push_back({q[0], q[1], q[2]});
      out_.triangles.push_back({q[0], q[2], q[3]});
    } else {
      out_.triangles.push_back({q[0], q[1], q[3]});
      out_.triangles.push_back({q[1], q[2], q[3]});
    }
  }

  std::uint8_t mask(const Cell& cell) const {
    const int node = NodeWindow::index(cell.i, cell.j, cell.k);
    int bits = 0;
    for (int c = 0; c < 8; ++c) bits |= is_left(node + corner_node(c)) ? 1 << c : 0;
    return static_cast<std::uint8_t>(bits);
  }

  /// Loops of a cell: joined at a face where the cells on both its sides would lead one loop
  /// through it twice, which would give an edge four triangles.
  const CubeLoops& loops(const Cell& cell) const {
    const LoopTable& table = loop_table();
    const std::size_t m = mask(cell);
    const int face = table.bad_face[m];
    if (face < 0) return table.plain[m];
    const int step = face % 2 == 1 ? 1 : -1, axis = face / 2;
    const Cell next{cell.i + (axis == 0 ? step : 0), cell.j + (axis == 1 ? step : 0),
                    cell.k + (axis == 2 ? step : 0)};
    const bool both = table.bad_face[mask(next)] == (face ^ 1);
    return both ? table.joined[m] : table.plain[m];
  }

  /// Vertex of the cell's loop that takes its edge.
  std::uint32_t vertex(const Cell& cell, int edge) {
    const CubeLoops& of = loops(cell);
    const auto loop = static_cast<std::size_t>(of.of_edge[static_cast<std::size_t>(edge)]);
    const std::size_t place =
        kMostLoops * static_cast<std::size_t>(NodeWindow::index(cell.i, cell.j, cell.k)) + loop;
    if (vertex_[place] == kNone) {
      vertex_[place] = static_cast<std::uint16_t>(out_.vertices.size());
      make_vertex(cell, of, loop);
    }
    return vertex_[place];
  }

  void make_vertex(const Cell& cell, const CubeLoops& of, std::size_t loop) {
    CellVertex meet;
    const int node = NodeWindow::index(cell.i, cell.j, cell.k);
    for (int e = 0; e < 12; ++e) {
      if (of.of_edge[static_cast<std::size_t>(e)] != static_cast<int>(loop)) continue;
      const int corner = cube_edge_corners(e).first;
      const EdgeCrossing& found = crossing(node + corner_node(corner), e / 4);
      Vec3 p(corner & 1, corner >> 1 & 1, corner >> 2);
      p[e / 4] += found.way;
      meet.add(p, found.normal);
    }
    const Vec3 first(8 * block_[0] + cell.i, 8 * block_[1] + cell.j, 8 * block_[2] + cell.k);
    out_.vertices.push_back(grid_.lo + grid_.cell_m * (first + meet.place()));
    out_.normals.push_back(meet.normal());
    on_rim_.push_back(meet.on_rim());
    out_.keys.push_back(key(cell, loop));
  }

  std::uint64_t key(const Cell& cell, std::size_t loop) const {
    const auto place = [&](int axis, int c) {
      return static_cast<std::uint64_t>(8 * block_[static_cast<std::size_t>(axis)] + c + 1);
    };
    return ((place(2, cell.k) << 20 | place(1, cell.j)) << 20 | place(0, cell.i)) << 2 | loop;
  }

  const EdgeCrossing& crossing(int node, int axis) {
    std::uint16_t& at =
        crossing_[3 * static_cast<std::size_t>(node) + static_cast<std::size_t>(axis)];
    if (at == kNone) {
      at = static_cast<std::uint16_t>(crossings_.size());
      crossings_.push_back(edge_crossing(window_, 1e6 * grid_.cell_m, node,
                                         kStride[static_cast<std::size_t>(axis)]));
    }
    return crossings_[at];
  }

  const NodeWindow& window_;
  const BlockGrid& grid_;
  const std::array<int, 3>& block_;
  SurfacePatch& out_;
  std::array<std::uint8_t, NodeWindow::kCount> left_;
  std::array<std::uint16_t, kMostLoops * NodeWindow::kCount> vertex_;
  std::array<std::uint16_t, 3 * NodeWindow::kCount> crossing_;
  std::vector<EdgeCrossing> crossings_;
  std::vector<bool> on_rim_;
};

}  // namespace

void make_patch(const NodeWindow& window, const BlockGrid& grid, const std::array<int, 3>& block,
                SurfacePatch& out) {
  PatchMaker(window, grid, block, out).run();
}

}  // namespace osteon
