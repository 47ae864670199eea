#include "osteon/mesh/isosurface.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "osteon/mesh/cube_loops.h"
#include "repair/uncross.h"
#include "surface/isosurface_grid.h"
#include "surface/surface_relax.h"

namespace osteon {
namespace {

constexpr std::uint32_t kNoCell = 0xffffffffu;

/// A cell of the grid that the surface passes: one vertex for each loop of crossed edges.
struct ActiveCell {
  int x, y, z;
  std::uint8_t inside;            ///< bit c: corner c is inside
  std::uint8_t joined_faces = 0;  ///< bit f: the inside corners of ambiguous face f are joined
  CubeLoops loops;
  std::uint32_t first_vertex = 0;
};

class DualSurface {
 public:
  explicit DualSurface(const IsosurfaceGrid& grid) : grid_(grid) {
    find_cells();
    resolve_ambiguous_faces();
    place_vertices();
    make_quads();
  }
  TriMesh mesh;
  std::vector<std::array<std::uint32_t, 4>> quads;

 private:
  void find_cells();
  void resolve_ambiguous_faces();
  void place_vertices();
  void make_quads();
  Vec3 crossing(const ActiveCell& cell, int edge) const;
  std::uint8_t inside_mask(int x, int y, int z) const;

  std::uint32_t& slot(int x, int y, int z) { return cell_at_[grid_.index(x, y, z)]; }
  ActiveCell& neighbour(const ActiveCell& cell, int axis, int step) {
    int at[3] = {cell.x, cell.y, cell.z};
    at[axis] += step;
    return cells_[slot(at[0], at[1], at[2])];
  }

  const IsosurfaceGrid& grid_;
  std::vector<ActiveCell> cells_;
  std::vector<std::uint32_t> cell_at_;
};

std::uint8_t DualSurface::inside_mask(int x, int y, int z) const {
  int mask = 0;
  for (int c = 0; c < 8; ++c)
    if (grid_.value(x + (c & 1), y + ((c >> 1) & 1), z + (c >> 2)) < 0) mask |= 1 << c;
  return static_cast<std::uint8_t>(mask);
}

void DualSurface::find_cells() {
  cell_at_.assign(grid_.size(), kNoCell);
  for (int z = 0; z + 1 < grid_.nz(); ++z)
    for (int y = 0; y + 1 < grid_.ny(); ++y)
      for (int x = 0; x + 1 < grid_.nx(); ++x) {
        const std::uint8_t mask = inside_mask(x, y, z);
        if (mask == 0 || mask == 255) continue;
        slot(x, y, z) = static_cast<std::uint32_t>(cells_.size());
        cells_.push_back({x, y, z, mask, 0, cube_loops(mask, 0), 0});
      }
}

/// An edge between the same two vertices would carry four triangles where both cells of an
/// ambiguous face lead one loop through it twice. Joining the face's inside corners splits both
/// loops; splitting never makes another face bad, so one pass is enough.
void DualSurface::resolve_ambiguous_faces() {
  for (ActiveCell& cell : cells_)
    for (int axis = 0; axis < 3; ++axis) {
      const int upper = 2 * axis + 1, lower = 2 * axis;
      if (!face_is_ambiguous(cell.inside, upper)) continue;
      ActiveCell& next = neighbour(cell, axis, +1);
      if (!one_loop_takes_face(cell.loops, upper) || !one_loop_takes_face(next.loops, lower))
        continue;
      cell.joined_faces = static_cast<std::uint8_t>(cell.joined_faces | (1 << upper));
      next.joined_faces = static_cast<std::uint8_t>(next.joined_faces | (1 << lower));
      cell.loops = cube_loops(cell.inside, cell.joined_faces);
      next.loops = cube_loops(next.inside, next.joined_faces);
    }
}

Vec3 DualSurface::crossing(const ActiveCell& cell, int edge) const {
  const auto [c0, c1] = cube_edge_corners(edge);
  const int x = cell.x, y = cell.y, z = cell.z;
  const double a = grid_.value(x + (c0 & 1), y + ((c0 >> 1) & 1), z + (c0 >> 2));
  const double b = grid_.value(x + (c1 & 1), y + ((c1 >> 1) & 1), z + (c1 >> 2));
  const Vec3 p0 = grid_.point(x + (c0 & 1), y + ((c0 >> 1) & 1), z + (c0 >> 2));
  const Vec3 p1 = grid_.point(x + (c1 & 1), y + ((c1 >> 1) & 1), z + (c1 >> 2));
  return p0 + (a / (a - b)) * (p1 - p0);
}

void DualSurface::place_vertices() {
  for (ActiveCell& cell : cells_) {
    cell.first_vertex = static_cast<std::uint32_t>(mesh.vertices.size());
    for (int loop = 0; loop < cell.loops.count; ++loop) {
      Vec3 sum = Vec3::Zero();
      int n = 0;
      for (int e = 0; e < 12; ++e) {
        if (cell.loops.of_edge[e] != loop) continue;
        sum += crossing(cell, e);
        ++n;
      }
      mesh.vertices.push_back(sum / n);
    }
  }
}

/// Each crossed grid edge, seen from the cell whose lowest corner starts it, is ringed by four
/// cells; their vertices on that edge make a quad.
void DualSurface::make_quads() {
  for (const ActiveCell& cell : cells_)
    for (int axis = 0; axis < 3; ++axis) {
      const bool from_inside = (cell.inside & 1) != 0;
      const bool to_inside = (cell.inside >> (1 << axis) & 1) != 0;
      if (from_inside == to_inside) continue;
      std::array<std::uint32_t, 4> quad{};
      for (int k = 0; k < 4; ++k) {
        const int du = (k == 0 || k == 3) ? 1 : 0, dv = k < 2 ? 1 : 0;
        int at[3] = {cell.x, cell.y, cell.z};
        at[(axis + 1) % 3] -= du;
        at[(axis + 2) % 3] -= dv;
        const ActiveCell& ring = cells_[slot(at[0], at[1], at[2])];
        const int edge = 4 * axis + du + 2 * dv;
        quad[static_cast<std::size_t>(k)] =
            ring.first_vertex + static_cast<std::uint32_t>(ring.loops.of_edge[edge]);
      }
      if (!from_inside) std::swap(quad[1], quad[3]);
      quads.push_back(quad);
    }
}

/// Cuts each quad along its shorter diagonal.
void cut_quads(const std::vector<std::array<std::uint32_t, 4>>& quads, TriMesh& mesh) {
  for (const auto& q : quads) {
    const auto& v = mesh.vertices;
    if ((v[q[0]] - v[q[2]]).squaredNorm() <= (v[q[1]] - v[q[3]]).squaredNorm()) {
      mesh.triangles.push_back({q[0], q[1], q[2]});
      mesh.triangles.push_back({q[0], q[2], q[3]});
    } else {
      mesh.triangles.push_back({q[0], q[1], q[3]});
      mesh.triangles.push_back({q[1], q[2], q[3]});
    }
  }
}

/// A field of which nothing is known but what its options promise.
class PlainField : public LocalField {
 public:
  PlainField(const ScalarField& field, const IsosurfaceOptions& options)
      : field_(field), stretch_(options.stretch), slack_(options.slack_m) {}
  double at(const Vec3& p) const override { return field_(p); }
  Near near(const Vec3& center, double radius) const override {
    const double value = field_(center);
    if (!std::isfinite(value) || std::abs(value) <= stretch_ * radius + slack_) return {};
    return {value > 0 ? 1 : -1};
  }

 private:
  const ScalarField& field_;
  double stretch_, slack_;
};

}  // namespace

Result<TriMesh> isosurface(const ScalarField& field, const Aabb& box,
                           const IsosurfaceOptions& options) {
  if (!(options.stretch >= 1) || !(options.slack_m >= 0))
    return fail("stretch must be 1 or more and slack 0 or more", "isosurface");
  return isosurface(PlainField(field, options), box, options);
}

Result<TriMesh> isosurface(const LocalField& field, const Aabb& box,
                           const IsosurfaceOptions& options) {
  auto grid = IsosurfaceGrid::sample(field, box, options.cell_m);
  if (!grid) return tl::unexpected(grid.error());
  DualSurface surface(*grid);
  if (surface.mesh.vertices.empty())
    return fail("no point of the grid is inside the surface", "isosurface",
                "Choose a smaller cell or another box");
  const std::vector<Vec3> home = surface.mesh.vertices;
  relax_on_surface(field, surface.quads, options, surface.mesh.vertices);
  cut_quads(surface.quads, surface.mesh);
  if (options.uncrossed) uncross(surface.mesh, home);
  return std::move(surface.mesh);
}

}  // namespace osteon
