#include "knee/acl_frame.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "osteon/mesh/measure.h"

namespace osteon {
namespace {

constexpr double kPlateauDepth_m = 0.012;  // what of the tibia counts as its plateau
constexpr double kSame_m = 1e-7;

Result<Vec3> place_of(const CaseDef& def, const KneeParts& parts, const char* name) {
  for (const Landmark& landmark : def.landmarks)
    if (landmark.name == name) return parts.place(parts.femur, landmark.p_W);
  return fail("it lacks the landmark " + std::string(name), "case '" + def.name + "'",
              "Make a knee with osteon anatomy make knee, or use builtin:knee");
}

Vec3 seen_from_side(Vec3 v) {
  v.y() = 0;
  return v.normalized();
}

// Distance along the line to a triangle (Moeller and Trumbore 1997); edges count for both sides.
std::optional<double> crossing(const TriMesh& mesh, const Triangle& t, const Vec3& p,
                               const Vec3& d) {
  const Vec3& a = mesh.vertices[t[0]];
  const Vec3 e1 = mesh.vertices[t[1]] - a, e2 = mesh.vertices[t[2]] - a;
  const Vec3 h = d.cross(e2);
  const double det = e1.dot(h);
  if (det == 0) return std::nullopt;
  const Vec3 s = p - a;
  const double u = s.dot(h) / det;
  if (u < 0 || u > 1) return std::nullopt;
  const Vec3 q = s.cross(e1);
  const double v = d.dot(q) / det;
  if (v < 0 || u + v > 1) return std::nullopt;
  return e2.dot(q) / det;
}

// Direction of the largest spread in the picture from the side, to the back.
Vec3 slope_of(const TriMesh& layer, const Vec3& middle) {
  double xx = 0, xz = 0, zz = 0;
  for (const Vec3& vertex : layer.vertices) {
    const Vec3 d = vertex - middle;
    xx += d.x() * d.x();
    xz += d.x() * d.z();
    zz += d.z() * d.z();
  }
  const double angle = 0.5 * std::atan2(2 * xz, zz - xx);  // from z towards x
  return {-std::sin(angle), 0, -std::cos(angle)};
}

}  // namespace

Result<QuadrantGrid> quadrant_grid(const CaseDef& def, const KneeParts& parts) {
  const auto back = place_of(def, parts, "blumensaat_posterior");
  if (!back) return tl::unexpected(back.error());
  const auto front = place_of(def, parts, "blumensaat_anterior");
  if (!front) return tl::unexpected(front.error());
  QuadrantGrid grid;
  grid.axes.origin = *back;
  grid.axes.along = seen_from_side(*front - *back);
  grid.roof_m = grid.axes.along.dot(*front - *back);
  // A quarter turn from the front to the foot.
  grid.axes.across = {grid.axes.along.z(), 0, -grid.axes.along.x()};
  grid.hind = std::numeric_limits<double>::infinity();
  grid.front = -grid.hind;
  for (const Vec3& p : parts.femur.surface->mesh().vertices) {
    if (p.y() >= back->y() || grid.axes.v(p) < 0) continue;
    grid.hind = std::min(grid.hind, grid.axes.u(p));
    grid.front = std::max(grid.front, grid.axes.u(p));
    grid.height = std::max(grid.height, grid.axes.v(p));
  }
  if (!(grid.front - grid.hind > 0.01 && grid.height > 0.005))
    return fail("its lateral condyle does not reach below the roof of the notch",
                "case '" + def.name + "'",
                "Look at its landmarks blumensaat_posterior and "
                "blumensaat_anterior");
  return grid;
}

Result<PlateauGrid> plateau_grid(const CaseDef& def, const KneeParts& parts) {
  PlateauGrid grid;
  const TriMesh* medial = nullptr;
  double most_y = -std::numeric_limits<double>::infinity();
  for (const TriMesh& layer : parts.plateaus) {
    const Vec3 middle = centroid(layer);
    if (!(middle.y() > most_y)) continue;
    most_y = middle.y();
    grid.axes.origin = middle;
    medial = &layer;
  }
  if (medial) grid.axes.along = slope_of(*medial, grid.axes.origin);
  grid.axes.across = {-grid.axes.along.z(), 0, grid.axes.along.x()};
  grid.front = grid.lateral = std::numeric_limits<double>::infinity();
  grid.back = grid.medial = -grid.front;
  for (const Vec3& p : parts.tibia.surface->mesh().vertices) {
    if (grid.axes.v(p) > kPlateauDepth_m) continue;
    grid.front = std::min(grid.front, grid.axes.u(p));
    grid.back = std::max(grid.back, grid.axes.u(p));
    grid.lateral = std::min(grid.lateral, p.y());
    grid.medial = std::max(grid.medial, p.y());
  }
  if (!medial || !(grid.back - grid.front > 0.01 && grid.medial - grid.lateral > 0.01))
    return fail("it has no tibial plateau that could be measured", "case '" + def.name + "'");
  return grid;
}

std::vector<std::pair<double, double>> stretches_inside(const TriMesh& mesh, const Vec3& p,
                                                        const Vec3& direction) {
  std::vector<double> at;
  for (const Triangle& t : mesh.triangles)
    if (const auto s = crossing(mesh, t, p, direction)) at.push_back(*s);
  std::sort(at.begin(), at.end());
  // Through an edge both of its triangles are crossed.
  at.erase(std::unique(at.begin(), at.end(), [](double a, double b) { return b - a < kSame_m; }),
           at.end());
  std::vector<std::pair<double, double>> out;
  for (std::size_t i = 0; i + 1 < at.size(); i += 2) out.emplace_back(at[i], at[i + 1]);
  return out;
}

}  // namespace osteon
