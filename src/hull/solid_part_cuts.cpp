// Planes that may cut a part.
#include <cmath>

#include "solid_part.h"

namespace osteon::hull {
namespace {

/// Planes along the edges of the facet under the deepest place: of a coarse mesh the notch is one
/// of them.
void add_creases(HeightGrid& grid, const Vec3& deepest, const Vec3& up, std::vector<Plane>& cuts) {
  const TriMesh& mesh = grid.exact().mesh();
  const Triangle& t = mesh.triangles[grid.exact().closest(deepest).triangle];
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec3& a = mesh.vertices[t[k]];
    const Vec3 along = mesh.vertices[t[(k + 1) % 3]] - a;
    const Vec3 n = along.cross(up);
    if (along.norm() < 4 * grid.cell() || !(n.norm() > 0.1 * along.norm())) continue;
    cuts.push_back({n.normalized(), n.normalized().dot(a)});
  }
}

}  // namespace

std::vector<Plane> notch_cuts(const SolidPart& part, HeightGrid& grid) {
  std::vector<Plane> cuts;
  const Vec3 up = grid.upwards(part.excess.peak.at);
  if (up == Vec3::Zero()) return cuts;
  const Vec3 deepest = part.excess.peak.at - grid.at(part.excess.peak.at) * up;
  const Vec3 any = std::abs(up.x()) < 0.7 ? Vec3::UnitX() : Vec3::UnitY();
  const Vec3 e1 = up.cross(any).normalized();
  const Vec3 e2 = up.cross(e1);
  constexpr int kDirections = 8;
  for (int k = 0; k < kDirections; ++k) {
    // Half a circle without trigonometry: points of a square, then unit length.
    const double f = 2.0 * k / kDirections;
    const Vec3 n =
        (f <= 1 ? Vec3(e1 + (2 * f - 1) * e2) : Vec3((3 - 2 * f) * e1 + e2)).normalized();
    cuts.push_back({n, n.dot(deepest)});
  }
  add_creases(grid, deepest, up, cuts);
  return cuts;
}

std::vector<Plane> halving_cuts(const SolidPart& part) {
  std::vector<Plane> cuts;
  for (const Vec3& through : {part.excess.peak.at, part.box.center()})
    for (Eigen::Index k = 0; k < 3; ++k) cuts.push_back({Vec3::Unit(k), through[k]});
  return cuts;
}

}  // namespace osteon::hull
