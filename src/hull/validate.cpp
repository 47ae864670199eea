#include "osteon/hull/validate.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace osteon {

namespace {

using Real3 = Eigen::Matrix<long double, 3, 1>;
using Problems = std::vector<std::string>;

Real3 real(const Vec3& v) { return v.cast<long double>(); }

long double height(const Plane& plane, const Vec3& p) {
  return real(plane.n).dot(real(p)) - static_cast<long double>(plane.d);
}

bool sizes_agree(const Hull& hull, Problems& problems) {
  const std::size_t before = problems.size();
  if (hull.vertices.size() < 4) problems.push_back("fewer than four vertices");
  if (hull.planes.size() < 4) problems.push_back("fewer than four facets");
  if (hull.source.size() != hull.vertices.size()) problems.push_back("not one source per vertex");
  if (hull.plane_of.size() != hull.triangles.size()) {
    problems.push_back("not one plane index per triangle");
  }
  for (const Triangle& t : hull.triangles) {
    for (const std::uint32_t v : t) {
      if (v >= hull.vertices.size()) problems.push_back("a triangle refers to a missing vertex");
    }
  }
  for (const std::uint32_t p : hull.plane_of) {
    if (p >= hull.planes.size()) problems.push_back("a triangle refers to a missing plane");
  }
  return problems.size() == before;
}

void check_sources(const Hull& hull, std::span<const Vec3> points, Problems& problems) {
  std::vector<bool> used(points.size(), false);
  for (std::size_t i = 0; i < hull.vertices.size(); ++i) {
    const std::uint32_t s = hull.source[i];
    if (s >= points.size() || points[s] != hull.vertices[i]) {
      problems.push_back("vertex " + std::to_string(i) + " is not its point of the input");
    } else if (used[s]) {
      problems.push_back("point " + std::to_string(s) + " is two vertices");
    } else {
      used[s] = true;
    }
  }
}

using EdgeMap = std::map<std::pair<std::uint32_t, std::uint32_t>, std::size_t>;

/// Triangle on the left of each directed edge.
EdgeMap edges_of(const Hull& hull, Problems& problems) {
  EdgeMap edges;
  for (std::size_t i = 0; i < hull.triangles.size(); ++i) {
    const Triangle& t = hull.triangles[i];
    for (std::size_t k = 0; k < 3; ++k) {
      if (!edges.emplace(std::pair(t[k], t[(k + 1) % 3]), i).second) {
        problems.push_back("two triangles at an edge have opposite orientation");
      }
    }
  }
  return edges;
}

std::size_t count_reached(const Hull& hull, const EdgeMap& edges) {
  std::vector<bool> reached(hull.triangles.size(), false);
  std::vector<std::size_t> stack{0};
  reached[0] = true;
  std::size_t count = 0;
  while (!stack.empty()) {
    const Triangle& t = hull.triangles[stack.back()];
    stack.pop_back();
    ++count;
    for (std::size_t k = 0; k < 3; ++k) {
      const auto twin = edges.find({t[(k + 1) % 3], t[k]});
      if (twin == edges.end() || reached[twin->second]) continue;
      reached[twin->second] = true;
      stack.push_back(twin->second);
    }
  }
  return count;
}

void check_topology(const Hull& hull, const EdgeMap& edges, Problems& problems) {
  for (const auto& [edge, triangle] : edges) {
    if (!edges.contains({edge.second, edge.first})) {
      problems.push_back("the surface is open at triangle " + std::to_string(triangle));
    }
  }
  std::vector<bool> used(hull.vertices.size(), false);
  for (const Triangle& t : hull.triangles) {
    for (const std::uint32_t v : t) used[v] = true;
  }
  if (std::count(used.begin(), used.end(), false) != 0) {
    problems.push_back("a vertex belongs to no triangle");
  }
  const auto euler = static_cast<long>(hull.vertices.size()) - static_cast<long>(edges.size() / 2) +
                     static_cast<long>(hull.triangles.size());
  if (euler != 2) problems.push_back("Euler characteristic " + std::to_string(euler) + ", not 2");
  if (count_reached(hull, edges) != hull.triangles.size()) {
    problems.push_back("the surface is in several pieces");
  }
}

Real3 cross_of(const Hull& hull, const Triangle& t) {
  const Real3 a = real(hull.vertices[t[0]]);
  return (real(hull.vertices[t[1]]) - a).cross(real(hull.vertices[t[2]]) - a);
}

void check_planes(const Hull& hull, double tolerance_m, Problems& problems) {
  std::vector<bool> used(hull.planes.size(), false);
  for (std::size_t i = 0; i < hull.triangles.size(); ++i) {
    const Plane& plane = hull.planes[hull.plane_of[i]];
    used[hull.plane_of[i]] = true;
    for (const std::uint32_t v : hull.triangles[i]) {
      if (!(std::abs(height(plane, hull.vertices[v])) <= tolerance_m)) {
        problems.push_back("triangle " + std::to_string(i) + " is off its plane");
      }
    }
    if (!(cross_of(hull, hull.triangles[i]).dot(real(plane.n)) > 0)) {
      problems.push_back("triangle " + std::to_string(i) + " does not face outwards");
    }
  }
  for (std::size_t i = 0; i < hull.planes.size(); ++i) {
    if (!used[i]) problems.push_back("plane " + std::to_string(i) + " has no triangle");
    if (!(std::abs(hull.planes[i].n.norm() - 1) < 1e-12)) {
      problems.push_back("normal " + std::to_string(i) + " is not a unit vector");
    }
  }
}

/// Across every edge the neighbour's far vertex lies below: with a closed surface around its
/// centroid that makes the whole convex.
void check_convexity(const Hull& hull, const EdgeMap& edges, double tolerance_m,
                     Problems& problems) {
  for (const auto& [edge, triangle] : edges) {
    const Plane& plane = hull.planes[hull.plane_of[triangle]];
    const auto twin = edges.find({edge.second, edge.first});
    if (twin == edges.end()) continue;
    for (const std::uint32_t v : hull.triangles[twin->second]) {
      if (!(height(plane, hull.vertices[v]) <= tolerance_m)) {
        problems.push_back("not convex at triangle " + std::to_string(triangle));
      }
    }
  }
  for (const Plane& plane : hull.planes) {
    if (!(height(plane, hull.centroid) <= tolerance_m))
      problems.push_back("the centroid is not inside");
  }
}

void check_inside(const Hull& hull, std::span<const Vec3> points, double tolerance_m,
                  Problems& problems) {
  for (std::size_t i = 0; i < hull.planes.size(); ++i) {
    const Plane& plane = hull.planes[i];
    double highest = -1e300;
    for (const Vec3& p : points) highest = std::max(highest, plane.n.dot(p) - plane.d);
    if (!(highest <= tolerance_m)) {
      problems.push_back("a point is " + std::to_string(highest) + " m outside facet " +
                         std::to_string(i));
    }
  }
}

/// The volume may be off by what a shift of the surface by the tolerance makes.
void check_volume(const Hull& hull, double tolerance_m, Problems& problems) {
  const Real3 origin = real(hull.centroid);
  long double six_volumes = 0, scale = 0, area = 0;
  for (const Triangle& t : hull.triangles) {
    const Real3 cross = cross_of(hull, t);
    const long double w = cross.dot(real(hull.vertices[t[0]]) - origin);
    area += 0.5L * cross.norm();
    six_volumes += w;
    scale += std::abs(w);
  }
  if (!(six_volumes > -6 * tolerance_m * area)) problems.push_back("the volume is negative");
  const long double error = std::abs(six_volumes / 6 - static_cast<long double>(hull.volume));
  if (!(error <= 1e-9L * scale + tolerance_m * area)) {
    problems.push_back("the volume is not that of the triangles");
  }
}

}  // namespace

std::vector<std::string> validate_hull(const Hull& hull, std::span<const Vec3> points,
                                       double tolerance_m) {
  Problems problems;
  if (!sizes_agree(hull, problems)) return problems;
  check_sources(hull, points, problems);
  const EdgeMap edges = edges_of(hull, problems);
  check_topology(hull, edges, problems);
  check_planes(hull, tolerance_m, problems);
  check_convexity(hull, edges, tolerance_m, problems);
  check_inside(hull, points, tolerance_m, problems);
  check_volume(hull, tolerance_m, problems);
  return problems;
}

}  // namespace osteon
