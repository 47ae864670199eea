#include "first_edge.h"

#include <vector>

#include "exact/predicates.h"
#include "polygon.h"

namespace osteon::hull {

namespace {

int turn_xy(const Cloud& cloud, std::uint32_t a, std::uint32_t b, std::uint32_t c) {
  return orient2d(cloud.raw(a), cloud.raw(b), cloud.raw(c), 0, 1, cloud.exact_counter());
}

bool same_xy(const Vec3& p, const Vec3& q) { return p.x() == q.x() && p.y() == q.y(); }

std::uint32_t lexicographic_minimum(const Cloud& cloud, std::span<const std::uint32_t> points) {
  std::uint32_t lowest = points[0];
  for (const std::uint32_t i : points) {
    if (lexicographic_less(cloud.raw(i), cloud.raw(lowest))) lowest = i;
  }
  return lowest;
}

/// Seen along z: a point b that leaves no other on the right of the line from the corner a.
std::uint32_t rightmost_from(const Cloud& cloud, std::span<const std::uint32_t> points,
                             std::uint32_t a) {
  std::uint32_t b = a;
  for (const std::uint32_t i : points) {
    if (same_xy(cloud.raw(i), cloud.raw(a))) continue;
    if (b == a || turn_xy(cloud, a, b, i) < 0) b = i;
  }
  return b;
}

}  // namespace

// The upright plane through a and b supports the hull: the points on it make a facet or an edge.
DirectedEdge first_edge(const Cloud& cloud, std::span<const std::uint32_t> points) {
  const std::uint32_t a = lexicographic_minimum(cloud, points);
  const std::uint32_t b = rightmost_from(cloud, points, a);
  std::vector<std::uint32_t> on_plane;
  std::uint32_t last = a, off_line = a;
  for (const std::uint32_t i : points) {
    if (!same_xy(cloud.raw(i), cloud.raw(a)) && turn_xy(cloud, a, b, i) != 0) continue;
    on_plane.push_back(i);
    if (lexicographic_less(cloud.raw(last), cloud.raw(i))) last = i;
    if (!collinear(cloud.raw(a), cloud.raw(b), cloud.raw(i), cloud.exact_counter())) off_line = i;
  }
  if (off_line == a) return {a, last};
  const std::vector<std::uint32_t> corners = wrap_polygon(cloud, on_plane, a, b, off_line);
  return {corners[0], corners[1]};
}

}  // namespace osteon::hull
