#include "osteon/hull/hull.h"

#include <algorithm>

#include "cloud.h"
#include "facet_plane.h"
#include "osteon/base/clock.h"
#include "quickhull.h"
#include "spatial_order.h"
#include "wrapping.h"

namespace osteon {

namespace {

using hull::WrappedFacets;

constexpr std::uint32_t kUnnumbered = 0xffffffffu;

/// Vertex number of each input point. Corners are in the order of the input, so that the result
/// does not depend on the path taken.
std::vector<std::uint32_t> number_vertices(std::size_t points, const WrappedFacets& facets) {
  std::vector<std::uint32_t> number(points, kUnnumbered);
  for (const std::uint32_t s : facets.corners) number[s] = 0;
  std::uint32_t count = 0;
  for (std::uint32_t& n : number) {
    if (n != kUnnumbered) n = count++;
  }
  return number;
}

void fill_vertices(Hull& result, std::span<const Vec3> points,
                   std::span<const std::uint32_t> number) {
  for (std::uint32_t s = 0; s < points.size(); ++s) {
    if (number[s] == kUnnumbered) continue;
    result.source.push_back(s);
    result.vertices.push_back(points[s]);
  }
}

/// One plane a polygon, and its triangles as a fan.
void fill_facets(Hull& result, const WrappedFacets& facets, std::span<const std::uint32_t> number) {
  std::vector<std::uint32_t> polygon;
  result.planes.reserve(facets.size());
  const std::size_t triangles = 2 * result.vertices.size() - 4;  // Euler
  result.triangles.reserve(triangles);
  result.plane_of.reserve(triangles);
  for (std::size_t i = 0; i < facets.size(); ++i) {
    polygon.clear();
    for (const std::uint32_t s : facets.polygon(i)) polygon.push_back(number[s]);
    for (std::size_t k = 2; k < polygon.size(); ++k) {
      result.triangles.push_back({polygon[0], polygon[k - 1], polygon[k]});
      result.plane_of.push_back(static_cast<std::uint32_t>(i));
    }
    result.planes.push_back(hull::facet_plane(result.vertices, polygon));
  }
}

Vec3 mean(std::span<const Vec3> points) {
  Vec3 sum = Vec3::Zero();
  for (const Vec3& p : points) sum += p / static_cast<double>(points.size());
  return sum;
}

/// Sums tetrahedra from a vertex, so that a distant origin costs no digits. A hull so flat that its
/// volume is lost in rounding has the mean of its vertices for a centre.
void fill_volume(Hull& result) {
  const Vec3 apex = result.vertices[0];
  double six_volumes = 0, reach = 0;
  Vec3 moment = Vec3::Zero();
  for (const Triangle& t : result.triangles) {
    const Vec3 a = result.vertices[t[0]] - apex;
    const Vec3 b = result.vertices[t[1]] - apex;
    const Vec3 c = result.vertices[t[2]] - apex;
    const double w = a.dot(b.cross(c));
    six_volumes += w;
    moment += w * 0.25 * (a + b + c);
    reach = std::max(reach, a.cwiseAbs().maxCoeff());
  }
  result.volume = std::max(six_volumes / 6, 0.0);
  const bool lost = !(six_volumes > 1e-12 * reach * reach * reach);
  result.centroid = lost ? mean(result.vertices) : Vec3(apex + moment / six_volumes);
}

Hull assemble(std::span<const Vec3> points, const WrappedFacets& facets) {
  Hull result;
  const std::vector<std::uint32_t> number = number_vertices(points.size(), facets);
  fill_vertices(result, points, number);
  fill_facets(result, facets, number);
  fill_volume(result);
  return result;
}

/// Every 8^k-th point first, then the others between them: a polytope that has grown evenly has
/// facets about as large as the steps of the order, so a new point is found near the last one
/// (Amenta, Choi, Rote, "Incremental Constructions con BRIO", 2003).
void insert(hull::Polytope& polytope, std::span<const std::uint32_t> order) {
  constexpr std::size_t kAhead = 8;
  const auto add = [&](std::size_t i, std::size_t step) {
    if (i + kAhead * step < order.size()) polytope.fetch(order[i + kAhead * step]);
    polytope.add(order[i]);
  };
  polytope.reserve(order.size());
  std::size_t step = 1;
  while (order.size() / step > 16 * polytope.vertices().size()) step *= 8;
  for (std::size_t i = 0; i < order.size(); i += step) add(i, step);
  for (; step > 1; step /= 8) {
    for (std::size_t i = 0; i < order.size(); i += step / 8) {
      if (i % step != 0) add(i, step / 8);
    }
  }
}

HullOutcome build(std::span<const Vec3> points, HullStats& stats) {
  if (points.size() < 4) return {std::nullopt, HullFailure::kTooFewPoints};
  const Aabb box = hull::finite_box(points);
  if (box.empty()) return {std::nullopt, HullFailure::kNotFinite};
  const hull::Cloud cloud(points, box);
  hull::FirstStage first = hull::quickhull(cloud);
  stats.exact_tests = cloud.exact_tests();
  if (!first.polytope) return {std::nullopt, first.failure};
  hull::Polytope& polytope = *first.polytope;
  const hull::SpatialOrder order = hull::spatial_order(cloud, polytope, first.points);
  insert(polytope, order.points);
  HullOutcome outcome{assemble(points, hull::wrap(cloud, polytope))};
  stats.duplicates = order.copies;
  stats.given_to_wrapping = polytope.vertices().size();
  stats.discarded_by_quickhull = points.size() - order.copies - stats.given_to_wrapping;
  stats.discarded_by_wrapping = stats.given_to_wrapping - outcome.hull->vertices.size();
  stats.exact_tests = cloud.exact_tests();
  return outcome;
}

}  // namespace

std::string_view describe(HullFailure failure) {
  switch (failure) {
    case HullFailure::kTooFewPoints:
      return "fewer than four points";
    case HullFailure::kNotFinite:
      return "a coordinate is not finite";
    case HullFailure::kAllAtOnePoint:
      return "all points coincide";
    case HullFailure::kAllOnALine:
      return "all points lie on one line";
    case HullFailure::kAllInAPlane:
      return "all points lie in one plane";
  }
  return "unknown";
}

HullOutcome build_hull(std::span<const Vec3> points, HullStats* stats) {
  HullStats mine;
  mine.input_points = points.size();
  const std::int64_t start_ns = steady_now_ns();
  HullOutcome outcome = build(points, mine);
  mine.seconds = static_cast<double>(steady_now_ns() - start_ns) * 1e-9;
  if (stats) *stats = mine;
  return outcome;
}

TriMesh to_mesh(const Hull& hull) { return {hull.vertices, hull.triangles}; }

}  // namespace osteon
