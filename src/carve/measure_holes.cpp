#include "osteon/carve/measure_holes.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "measure_wall.h"

namespace osteon {
namespace {

using measure::Cylinder;
using measure::Faces;
using measure::kNoFace;
using measure::WallRim;

/// Patches of so many triangles decide where a wall may be.
constexpr std::size_t kPatch = 48;
constexpr double kSmooth = 0.87;  // cosine of 30 degrees: no edge of a wall is sharper

/// A piece of a wall in one.
struct Wall {
  Cylinder fit;
  std::vector<std::uint32_t> faces;
  std::vector<WallRim> rims;
};

/// Whether the surface at f bends inwards over some smooth edge, as every wall does.
bool bends_in(const Faces& faces, std::uint32_t f) {
  const Triangle& t = faces.mesh.triangles[f];
  for (const std::uint32_t g : faces.across[f]) {
    if (g == kNoFace || faces.areas[g] == 0) continue;
    const double cosine = faces.normals[f].dot(faces.normals[g]);
    if (cosine < kSmooth || cosine > 1 - 1e-7) continue;
    Vec3 away = Vec3::Zero();
    for (const std::uint32_t v : faces.mesh.triangles[g]) away += faces.mesh.vertices[v];
    if (faces.normals[f].dot(away / 3 - faces.mesh.vertices[t[0]]) > 0) return true;
  }
  return false;
}

std::vector<std::uint32_t> smooth_patch(const Faces& faces, std::uint32_t seed) {
  std::vector<std::uint32_t> patch{seed};
  for (std::size_t i = 0; i < patch.size() && patch.size() < kPatch; ++i)
    for (const std::uint32_t g : faces.across[patch[i]]) {
      if (g == kNoFace || faces.normals[patch[i]].dot(faces.normals[g]) < kSmooth) continue;
      if (std::find(patch.begin(), patch.end(), g) == patch.end()) patch.push_back(g);
    }
  return patch;
}

bool has_size(const Cylinder& fit, const HoleOptions& options) {
  return 2 * fit.radius >= options.least_diameter_m && 2 * fit.radius <= options.largest_diameter_m;
}

/// A patch bends over a small part of the way round: it knows its radius to about a third.
bool may_have_size(const Cylinder& fit, const HoleOptions& options) {
  constexpr double kRoughly = 1.5;
  return 2 * fit.radius * kRoughly >= options.least_diameter_m &&
         2 * fit.radius <= kRoughly * options.largest_diameter_m;
}

std::optional<Wall> wall_at(const Faces& faces, std::uint32_t seed, const HoleOptions& options) {
  auto fit = measure::fit_cylinder(faces, smooth_patch(faces, seed));
  if (!fit || !may_have_size(*fit, options) || fit->roundness > 2 * options.roundness_m)
    return std::nullopt;
  Wall wall;
  for (int round = 0; round < 4; ++round) {
    wall.faces = measure::grow_wall(faces, seed, *fit, 3 * options.roundness_m);
    if (wall.faces.size() < 8) return std::nullopt;
    fit = measure::fit_cylinder(faces, wall.faces);
    if (!fit || !may_have_size(*fit, options)) return std::nullopt;
  }
  if (fit->roundness > options.roundness_m || !has_size(*fit, options)) return std::nullopt;
  wall.fit = *fit;
  if (measure::coverage(faces, wall.faces, *fit) < options.least_coverage_rad) return std::nullopt;
  wall.rims = measure::rims_of(faces, wall.faces, *fit);
  return wall;
}

std::vector<Wall> find_walls(const Faces& faces, const HoleOptions& options) {
  std::vector<Wall> walls;
  std::vector<bool> done(faces.normals.size(), false);
  for (std::uint32_t f = 0; f < done.size(); ++f) {
    if (done[f] || faces.areas[f] == 0 || !bends_in(faces, f)) continue;
    auto wall = wall_at(faces, f, options);
    if (!wall) continue;
    for (const std::uint32_t g : wall->faces) done[g] = true;
    walls.push_back(std::move(*wall));
  }
  return walls;
}

/// Whether both lie on one cylinder.
bool share_axis(const Wall& a, const Wall& b, const HoleOptions& options) {
  const Vec3 between = b.fit.point - a.fit.point;
  const double aside = (between - a.fit.axis * a.fit.axis.dot(between)).norm();
  return std::abs(a.fit.axis.dot(b.fit.axis)) > 0.9995 && aside < 4 * options.roundness_m &&
         std::abs(a.fit.radius - b.fit.radius) < 2 * options.roundness_m;
}

/// The next surface from p along the unit vector d.
struct NextSurface {
  double way = std::numeric_limits<double>::infinity();  ///< m; infinite: there is none
  bool leaves = true;                                    ///< bone; else the ray enters it
};

NextSurface next_surface(const TriMesh& mesh, const Vec3& p, const Vec3& d) {
  NextSurface next;
  for (const Triangle& t : mesh.triangles) {
    const Vec3 &a = mesh.vertices[t[0]], ab = mesh.vertices[t[1]] - a, ac = mesh.vertices[t[2]] - a;
    const Vec3 q = d.cross(ac);
    const double det = ab.dot(q);  // against the triangle's normal along the ray
    if (det == 0) continue;
    const Vec3 s = p - a;
    const double u = s.dot(q) / det;
    if (u < 0 || u > 1) continue;
    const Vec3 r = s.cross(ab);
    const double v = d.dot(r) / det;
    if (v < 0 || u + v > 1) continue;
    const double way = ac.dot(r) / det;
    if (way <= 1e-9 || way >= next.way) continue;
    next = {way, det < 0};
  }
  return next;
}

/// Whether a drill's point ended in bone beyond the rim: its wall ends in a plane, and bone closes
/// the axis no farther beyond than a point of 60 degrees reaches (1.73 radii) or a ball's end.
bool has_pointed_bottom(const TriMesh& mesh, const Cylinder& fit, const WallRim& rim, double way) {
  constexpr double kPlane = 0.3, kFrom = 0.1, kPoint = 1.8;  // in radii
  if (rim.highest - rim.lowest > kPlane * fit.radius) return false;
  const Vec3 p = fit.point + (rim.height - way * kFrom * fit.radius) * fit.axis;
  const NextSurface next = next_surface(mesh, p, way * fit.axis);
  return !next.leaves && next.way < (kFrom + kPoint) * fit.radius;
}

/// The triangles that a ray across the axis can meet between two heights.
TriMesh slice(const TriMesh& mesh, const Cylinder& fit, double low, double high) {
  TriMesh out;
  out.vertices = mesh.vertices;
  for (const Triangle& t : mesh.triangles) {
    double lo = std::numeric_limits<double>::infinity(), hi = -lo;
    for (const std::uint32_t v : t) {
      const double h = fit.axis.dot(mesh.vertices[v] - fit.point);
      lo = std::min(lo, h);
      hi = std::max(hi, h);
    }
    if (hi >= low && lo <= high) out.triangles.push_back(t);
  }
  return out;
}

void measure_thickness(const TriMesh& mesh, const Cylinder& fit, double low, double high,
                       Hole& hole) {
  constexpr int kAround = 72;
  if (!(high > low)) return;
  const Vec3 x = fit.axis.unitOrthogonal(), y = fit.axis.cross(x);
  const int rows = std::clamp(static_cast<int>((high - low) / 0.5e-3), 1, 80);
  for (int row = 0; row <= rows; ++row) {
    const double height = low + (high - low) * row / rows;
    const TriMesh level = slice(mesh, fit, height, height);
    for (int i = 0; i < kAround; ++i) {
      const double angle = 2 * M_PI * (i + 0.5) / kAround;
      const Vec3 d = std::cos(angle) * x + std::sin(angle) * y;
      // From just within bone, past the wall's own facets.
      const double start = fit.radius + 0.02e-3;
      const Vec3 p = fit.point + height * fit.axis + start * d;
      const NextSurface next = next_surface(level, p, d);
      const double way = next.leaves ? next.way + 0.02e-3 : 0;  // else it began beside the bone
      if (hole.thinnest_wall_m && way >= *hole.thinnest_wall_m) continue;
      if (!std::isfinite(way)) continue;
      hole.thinnest_wall_m = way;
      hole.thinnest_at = fit.point + height * fit.axis + fit.radius * d;
    }
  }
}

/// Rims of all walls on one axis, with heights along that of the first.
std::vector<WallRim> joined_rims(const Faces& faces, const std::vector<Wall>& walls,
                                 const Cylinder& fit) {
  std::vector<WallRim> rims;
  for (const Wall& wall : walls)
    for (const WallRim& rim : measure::rims_of(faces, wall.faces, fit)) rims.push_back(rim);
  std::sort(rims.begin(), rims.end(),
            [](const WallRim& a, const WallRim& b) { return a.height < b.height; });
  return rims;
}

std::optional<Hole> hole_of(const Faces& faces, const std::vector<Wall>& walls) {
  const Cylinder& fit = walls[0].fit;
  std::vector<WallRim> rims = joined_rims(faces, walls, fit);
  if (rims.size() < 2) return std::nullopt;
  for (const double way : {-1.0, 1.0}) {
    WallRim& end = way < 0 ? rims.front() : rims.back();
    end.bottom = end.bottom || has_pointed_bottom(faces.mesh, fit, end, way);
  }
  std::size_t round = 0;
  for (const WallRim& rim : rims) round += std::abs(rim.round) > M_PI ? 1 : 0;
  const WallRim &low = rims.front(), &high = rims.back();
  Hole hole;
  // A blind hole is entered at its open end.
  const bool turned = low.bottom && !high.bottom;
  const WallRim &first = turned ? high : low, &last = turned ? low : high;
  hole.entry = fit.point + first.height * fit.axis;
  hole.exit = fit.point + last.height * fit.axis;
  hole.axis = turned ? Vec3(-fit.axis) : fit.axis;
  hole.length_m = high.height - low.height;
  hole.diameter_m = 2 * fit.radius;
  hole.roundness_m = fit.roundness;
  hole.through = !low.bottom && !high.bottom;
  // Between parts of a bone an axis leaves and enters: those are ends as well.
  const std::size_t ends = std::min(round, 2 * walls.size());
  hole.side_openings = rims.size() - std::max<std::size_t>(ends, 2);
  measure_thickness(faces.mesh, fit, low.highest + (low.bottom ? 0 : fit.radius),
                    high.lowest - (high.bottom ? 0 : fit.radius), hole);
  return hole;
}

}  // namespace

std::vector<Hole> find_holes(const TriMesh& mesh, const HoleOptions& options) {
  const Faces faces(mesh);
  std::vector<Wall> walls = find_walls(faces, options);
  std::vector<Hole> holes;
  while (!walls.empty()) {
    std::vector<Wall> same{walls.front()}, others;
    for (std::size_t i = 1; i < walls.size(); ++i)
      (share_axis(same[0], walls[i], options) ? same : others).push_back(std::move(walls[i]));
    if (const auto hole = hole_of(faces, same)) holes.push_back(*hole);
    walls = std::move(others);
  }
  return holes;
}

std::optional<double> share_removed(const MeshDistance& before, const MeshDistance& after,
                                    const Vec3& center, double radius_m) {
  constexpr int kHalf = 16;
  std::size_t was = 0, gone = 0;
  const double step = radius_m / kHalf;
  for (int i = -kHalf; i <= kHalf; ++i)
    for (int j = -kHalf; j <= kHalf; ++j)
      for (int k = -kHalf; k <= kHalf; ++k) {
        if (i * i + j * j + k * k > kHalf * kHalf) continue;
        const Vec3 p = center + step * Vec3(i, j, k);
        if (before.closest(p).signed_distance >= 0) continue;
        ++was;
        if (after.closest(p).signed_distance > 0) ++gone;
      }
  if (was == 0) return std::nullopt;
  return static_cast<double>(gone) / static_cast<double>(was);
}

}  // namespace osteon
