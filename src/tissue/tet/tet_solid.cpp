#include "osteon/tissue/tet_solid.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "osteon/base/union_find.h"
#include "tet/tet_element.h"

namespace osteon {
namespace {

using Edge = std::array<std::uint32_t, 2>;

Result<void> check_parts(const TetMesh& mesh) {
  UnionFind parts(mesh.vertices.size());
  std::vector<bool> used(mesh.vertices.size(), false);
  for (const Tetrahedron& tet : mesh.tets)
    for (const std::uint32_t v : tet) {
      used[v] = true;
      parts.join(tet[0], v);
    }
  std::size_t roots = 0, idle = 0;
  for (std::uint32_t v = 0; v < mesh.vertices.size(); ++v) {
    if (!used[v]) ++idle;
    if (used[v] && parts.find(v) == v) ++roots;
  }
  if (roots > 1)
    return fail("has " + std::to_string(roots) + " parts that are not connected", "mesh",
                "Keep one of them, or join them");
  if (idle > 0)
    return fail("has " + std::to_string(idle) + " points that no tetrahedron uses", "mesh",
                "Write the file without them");
  return {};
}

Result<void> check_mesh(const TetMesh& mesh) {
  if (mesh.tets.empty()) return fail("has no tetrahedra", "mesh", "Give a solid");
  for (std::size_t i = 0; i < mesh.tets.size(); ++i) {
    const double volume = signed_volume(corners_of(mesh, mesh.tets[i]));
    if (!(std::isfinite(volume) && volume > 1e-21))
      return fail("tetrahedron " + std::to_string(i) + " is inverted or flat", "mesh",
                  "Check it with osteon mesh quality, and make the mesh again");
  }
  return check_parts(mesh);
}

TetElement element_of(const TetMesh& mesh, const Tetrahedron& tet) {
  TetElement e;
  std::copy(tet.begin(), tet.end(), e.node.begin());
  const std::array<Vec3, 4> c = corners_of(mesh, tet);
  e.volume_m3 = signed_volume(c);
  const Vec3 a = c[1] - c[0], b = c[2] - c[0], d = c[3] - c[0];
  const double per = 1 / (6 * e.volume_m3);
  e.slope[1] = per * b.cross(d);
  e.slope[2] = per * d.cross(a);
  e.slope[3] = per * a.cross(b);
  e.slope[0] = -(e.slope[1] + e.slope[2] + e.slope[3]);
  return e;
}

Edge edge_of(const TetElement& e, std::size_t k) {
  const std::uint32_t a = e.node[kTetEdges[k][0]], b = e.node[kTetEdges[k][1]];
  return {std::min(a, b), std::max(a, b)};
}

void add_middles(TetSolid& solid) {
  std::vector<Edge> edges;
  for (const TetElement& e : solid.elements)
    for (std::size_t k = 0; k < 6; ++k) edges.push_back(edge_of(e, k));
  std::sort(edges.begin(), edges.end());
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  for (const Edge& edge : edges)
    solid.rest_W.push_back(0.5 * (solid.rest_W[edge[0]] + solid.rest_W[edge[1]]));
  for (TetElement& e : solid.elements)
    for (std::size_t k = 0; k < 6; ++k) {
      const auto at = std::lower_bound(edges.begin(), edges.end(), edge_of(e, k));
      e.node[4 + k] = static_cast<std::uint32_t>(solid.corners + (at - edges.begin()));
    }
}

// A quarter each for corners; of quadratic elements in proportion to the diagonal of the consistent
// mass (Hinton, Rock, Zienkiewicz 1976): 1/36 a corner, 4/27 a middle.
void spread_mass(TetSolid& solid) {
  const bool quadratic = solid.order == TetOrder::kQuadratic;
  solid.mass_kg.assign(solid.rest_W.size(), 0.0);
  for (const TetElement& e : solid.elements) {
    const double mass = solid.material.density_kg_per_m3 * e.volume_m3;
    for (std::size_t a = 0; a < solid.nodes_an_element(); ++a)
      solid.mass_kg[e.node[a]] += mass * (!quadratic ? 0.25 : a < 4 ? 1.0 / 36 : 4.0 / 27);
  }
}

std::array<double, 4> barycentric(const TetSolid& solid, const TetElement& e, const Vec3& p) {
  std::array<double, 4> l{};
  for (std::size_t k = 0; k < 4; ++k)
    l[k] = (k == 0 ? 1 : 0) + e.slope[k].dot(p - solid.rest_W[e.node[0]]);
  return l;
}

}  // namespace

TetMesh split_into_tetrahedra(const HexGrid& grid) {
  TetMesh out;
  const auto& n = grid.cells;
  for (std::uint32_t z = 0; z <= n[2]; ++z)
    for (std::uint32_t y = 0; y <= n[1]; ++y)
      for (std::uint32_t x = 0; x <= n[0]; ++x)
        out.vertices.push_back(grid.origin_W + grid.cell_m * Vec3(x, y, z));
  const std::array<std::uint32_t, 3> step{1, n[0] + 1, (n[0] + 1) * (n[1] + 1)};
  // From the lowest corner to the highest along the three axes in each order; odd orders turned.
  constexpr std::array<std::array<std::size_t, 3>, 6> kOrders = {
      {{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {0, 2, 1}, {2, 1, 0}, {1, 0, 2}}};
  for (std::uint32_t z = 0; z < n[2]; ++z)
    for (std::uint32_t y = 0; y < n[1]; ++y)
      for (std::uint32_t x = 0; x < n[0]; ++x)
        for (std::size_t k = 0; k < 6; ++k) {
          const std::uint32_t a = x * step[0] + y * step[1] + z * step[2];
          const std::uint32_t b = a + step[kOrders[k][0]], c = b + step[kOrders[k][1]],
                              d = c + step[kOrders[k][2]];
          out.tets.push_back(k < 3 ? Tetrahedron{a, b, c, d} : Tetrahedron{a, c, b, d});
        }
  return out;
}

Result<TetSolid> make_tet_solid(const TetSolidDef& def) {
  for (const auto& checked : {check_material(def.material), check_mesh(def.mesh)})
    if (!checked) return tl::unexpected(checked.error());
  TetSolid solid;
  solid.material = def.material;
  solid.order = def.order;
  solid.corotated = def.corotated;
  solid.corners = def.mesh.vertices.size();
  solid.rest_W = def.mesh.vertices;
  for (const Tetrahedron& tet : def.mesh.tets) solid.elements.push_back(element_of(def.mesh, tet));
  if (solid.order == TetOrder::kQuadratic) add_middles(solid);
  spread_mass(solid);
  return solid;
}

SolidState::Field elastic_forces(const TetSolid& solid, const SolidState& state) {
  std::vector<Vec3> force(solid.rest_W.size(), Vec3::Zero());
  add_elastic(solid, state.moved_m, rotations(solid, state.moved_m), 1, force);
  SolidState::Field out;
  for (std::size_t k = 0; k < 3; ++k)
    for (const Vec3& f : force) out[k].push_back(f[static_cast<Eigen::Index>(k)]);
  return out;
}

std::optional<LostElement> find_lost(const TetSolid& solid, const SolidState& state) {
  for (std::size_t i = 0; i < solid.elements.size(); ++i) {
    const TetElement& e = solid.elements[i];
    Mat3 f = Mat3::Identity();
    Vec3 middle = Vec3::Zero();
    for (std::size_t k = 0; k < 4; ++k) {
      f += state.moved(e.node[k]) * e.slope[k].transpose();
      middle += 0.25 * solid.rest_W[e.node[k]];
    }
    const double j = f.determinant();
    if (std::isfinite(j) && (!solid.corotated || j > 0)) continue;
    return LostElement{i, middle, j};
  }
  return std::nullopt;
}

std::optional<TetPoint> find_point(const TetSolid& solid, const Vec3& p_W) {
  constexpr double kSlack = 1e-6;
  TetPoint best;
  double deepest = -kSlack;
  bool found = false;
  for (std::size_t i = 0; i < solid.elements.size(); ++i) {
    const auto l = barycentric(solid, solid.elements[i], p_W);
    const double depth = *std::min_element(l.begin(), l.end());
    if (!(depth >= deepest) || (found && depth == deepest)) continue;
    deepest = depth;
    found = true;
    best.element = i;
    for (std::size_t k = 0; k < 4; ++k)
      best.weight[k] = solid.order == TetOrder::kLinear ? l[k] : l[k] * (2 * l[k] - 1);
    for (std::size_t k = 0; k < 6; ++k)
      best.weight[4 + k] = 4 * l[kTetEdges[k][0]] * l[kTetEdges[k][1]];
  }
  return found ? std::optional(best) : std::nullopt;
}

Vec3 moved_at(const TetSolid& solid, const SolidState& state, const TetPoint& point) {
  Vec3 sum = Vec3::Zero();
  const TetElement& e = solid.elements[point.element];
  for (std::size_t a = 0; a < solid.nodes_an_element(); ++a)
    sum += point.weight[a] * state.moved(e.node[a]);
  return sum;
}

}  // namespace osteon
