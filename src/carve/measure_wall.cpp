#include "measure_wall.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <bitset>
#include <cmath>
#include <map>
#include <utility>

namespace osteon::measure {
namespace {

using Edge = std::pair<std::uint32_t, std::uint32_t>;

/// A direction at right angles to the axis, the same every time.
Vec3 across_axis(const Vec3& axis) { return axis.unitOrthogonal(); }

struct Circle {
  double x = 0, y = 0, radius = 0;
};

/// Circle of least squares in |p|^2 (Coope 1993): linear in the centre and r^2 - |c|^2.
std::optional<Circle> fit_circle(const std::vector<Eigen::Vector2d>& points) {
  Mat3 m = Mat3::Zero();
  Vec3 rhs = Vec3::Zero();
  for (const Eigen::Vector2d& p : points) {
    const Vec3 row(2 * p.x(), 2 * p.y(), 1);
    m += row * row.transpose();
    rhs += p.squaredNorm() * row;
  }
  if (!(std::abs(m.determinant()) > 0)) return std::nullopt;
  const Vec3 s = m.inverse() * rhs;
  const double r2 = s.z() + s.x() * s.x() + s.y() * s.y();
  if (!(r2 > 0) || !std::isfinite(r2)) return std::nullopt;
  return Circle{s.x(), s.y(), std::sqrt(r2)};
}

double angle_about(const Cylinder& fit, const Vec3& x, const Vec3& y, const Vec3& p) {
  const Vec3 r = fit.radial(p);
  return std::atan2(r.dot(y), r.dot(x));
}

}  // namespace

Faces::Faces(const TriMesh& m)
    : mesh(m),
      normals(m.triangles.size(), Vec3::Zero()),
      areas(m.triangles.size(), 0),
      across(m.triangles.size(), {kNoFace, kNoFace, kNoFace}) {
  std::vector<std::pair<Edge, std::uint32_t>> uses;  // edge, 3 * triangle + corner
  for (std::uint32_t i = 0; i < m.triangles.size(); ++i) {
    const Triangle& t = m.triangles[i];
    const Vec3 n = (m.vertices[t[1]] - m.vertices[t[0]]).cross(m.vertices[t[2]] - m.vertices[t[0]]);
    areas[i] = 0.5 * n.norm();
    if (areas[i] > 0) normals[i] = n / (2 * areas[i]);
    for (std::uint32_t k = 0; k < 3; ++k)
      uses.push_back({std::minmax(t[k], t[(k + 1) % 3]), 3 * i + k});
  }
  std::sort(uses.begin(), uses.end());
  for (std::size_t i = 0; i + 1 < uses.size(); ++i) {
    if (uses[i].first != uses[i + 1].first) continue;
    const std::uint32_t a = uses[i].second, b = uses[i + 1].second;
    across[a / 3][a % 3] = b / 3;
    across[b / 3][b % 3] = a / 3;
  }
}

std::optional<Cylinder> fit_cylinder(const Faces& faces, const std::vector<std::uint32_t>& patch) {
  Mat3 spread = Mat3::Zero();
  double area = 0;
  for (const std::uint32_t f : patch) {
    spread += faces.areas[f] * faces.normals[f] * faces.normals[f].transpose();
    area += faces.areas[f];
  }
  if (!(area > 0)) return std::nullopt;
  const Eigen::SelfAdjointEigenSolver<Mat3> solver(spread / area);
  const Vec3 values = solver.eigenvalues();  // ascending
  // Of a wall that goes all round, slanted and rounded rims may be more than of a patch.
  constexpr double kFlat = 1e-3, kFlatAllRound = 0.01;
  if (values[0] > std::max(kFlat, kFlatAllRound * values[1]) || values[1] < kFlat)
    return std::nullopt;
  Cylinder fit;
  fit.axis = solver.eigenvectors().col(0).normalized();
  const Vec3 x = across_axis(fit.axis), y = fit.axis.cross(x);
  const Vec3 origin = faces.mesh.vertices[faces.mesh.triangles[patch[0]][0]];
  std::vector<Eigen::Vector2d> points;
  for (const std::uint32_t f : patch)
    for (const std::uint32_t v : faces.mesh.triangles[f]) {
      const Vec3 r = faces.mesh.vertices[v] - origin;
      points.emplace_back(r.dot(x), r.dot(y));
    }
  const auto circle = fit_circle(points);
  if (!circle) return std::nullopt;
  fit.point = origin + circle->x * x + circle->y * y;
  fit.radius = circle->radius;
  double sum = 0;
  for (const Eigen::Vector2d& p : points) {
    const double off = std::hypot(p.x() - circle->x, p.y() - circle->y) - circle->radius;
    sum += off * off;
  }
  fit.roundness = std::sqrt(sum / static_cast<double>(points.size()));
  return fit;
}

std::vector<std::uint32_t> grow_wall(const Faces& faces, std::uint32_t seed, const Cylinder& fit,
                                     double off_m) {
  const auto follows = [&](std::uint32_t f) {
    Vec3 middle = Vec3::Zero();
    for (const std::uint32_t v : faces.mesh.triangles[f]) {
      const Vec3& p = faces.mesh.vertices[v];
      if (std::abs(fit.radial(p).norm() - fit.radius) > off_m) return false;
      middle += p / 3;
    }
    const Vec3 out = fit.radial(middle);
    // Slivers have no sure normal.
    return faces.areas[f] < 1e-12 || faces.normals[f].dot(out) < -0.95 * out.norm();
  };
  std::vector<std::uint32_t> wall;
  if (!follows(seed)) return wall;
  std::vector<bool> seen(faces.normals.size(), false);
  wall.push_back(seed);
  seen[seed] = true;
  for (std::size_t i = 0; i < wall.size(); ++i)
    for (const std::uint32_t next : faces.across[wall[i]]) {
      if (next == kNoFace || seen[next]) continue;
      seen[next] = true;
      if (follows(next)) wall.push_back(next);
    }
  return wall;
}

std::vector<WallRim> rims_of(const Faces& faces, const std::vector<std::uint32_t>& wall,
                             const Cylinder& fit) {
  std::vector<bool> in(faces.normals.size(), false);
  for (const std::uint32_t f : wall) in[f] = true;
  std::map<std::uint32_t, std::pair<std::uint32_t, std::uint32_t>> next;  // vertex, face beyond
  for (const std::uint32_t f : wall)
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t beyond = faces.across[f][k];
      if (beyond != kNoFace && in[beyond]) continue;
      const Triangle& t = faces.mesh.triangles[f];
      next[t[k]] = {t[(k + 1) % 3], beyond};
    }
  const Vec3 x = across_axis(fit.axis), y = fit.axis.cross(x);
  std::vector<WallRim> rims;
  while (!next.empty()) {
    WallRim rim;
    rim.lowest = std::numeric_limits<double>::infinity();
    rim.highest = -rim.lowest;
    double weight = 0, flat = 0, length = 0;
    auto at = next.begin();
    while (at != next.end()) {
      const auto [to, beyond] = at->second;
      const Vec3 a = faces.mesh.vertices[at->first], b = faces.mesh.vertices[to];
      next.erase(at);
      double turn = angle_about(fit, x, y, b) - angle_about(fit, x, y, a);
      turn -= 2 * M_PI * std::round(turn / (2 * M_PI));
      const double height = fit.axis.dot(0.5 * (a + b) - fit.point);
      rim.height += std::abs(turn) * height;
      weight += std::abs(turn);
      rim.round += turn;
      rim.lowest = std::min(rim.lowest, height);
      rim.highest = std::max(rim.highest, height);
      const double step = (b - a).norm();
      length += step;
      if (beyond != kNoFace && std::abs(faces.normals[beyond].dot(fit.axis)) > 0.999) flat += step;
      at = next.find(to);
    }
    rim.height = weight > 0 ? rim.height / weight : 0.5 * (rim.lowest + rim.highest);
    rim.bottom = flat > 0.9 * length && rim.highest - rim.lowest < 0.01 * fit.radius;
    rims.push_back(rim);
  }
  return rims;
}

double coverage(const Faces& faces, const std::vector<std::uint32_t>& wall, const Cylinder& fit) {
  constexpr std::size_t kBins = 180;
  std::bitset<kBins> seen;
  const Vec3 x = across_axis(fit.axis), y = fit.axis.cross(x);
  for (const std::uint32_t f : wall) {
    double lo = 0, hi = 0, first = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      const double angle = angle_about(fit, x, y, faces.mesh.vertices[faces.mesh.triangles[f][k]]);
      if (k == 0) first = angle;
      const double turn = angle - first - 2 * M_PI * std::round((angle - first) / (2 * M_PI));
      lo = std::min(lo, turn);
      hi = std::max(hi, turn);
    }
    const int from = static_cast<int>(std::floor((first + lo + 2 * M_PI) / (2 * M_PI) * kBins));
    const int to = static_cast<int>(std::floor((first + hi + 2 * M_PI) / (2 * M_PI) * kBins));
    for (int bin = from; bin <= to; ++bin) seen.set(static_cast<std::size_t>(bin) % kBins);
  }
  return 2 * M_PI * static_cast<double>(seen.count()) / kBins;
}

}  // namespace osteon::measure
