#include "facet_plane.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "exact/predicates.h"

namespace osteon::hull {

namespace {

/// Below this sine of the angle between two edges their plain cross product loses too much.
constexpr double kThin = 0.05;

/// Three corners spread over the polygon.
std::array<Vec3, 3> spread(std::span<const Vec3> points, std::span<const std::uint32_t> polygon) {
  const std::size_t n = polygon.size();
  return {points[polygon[0]], points[polygon[n / 3]], points[polygon[2 * n / 3]]};
}

/// Scaled by a power of two first where squares could leave the range; it rounds nothing, so either
/// way gives the same bits.
Vec3 unit(const Vec3& v) {
  const double square = v.squaredNorm();
  if (square > 1e-200 && square < 1e200) return v / std::sqrt(square);
  int exponent = 0;
  std::frexp(v.cwiseAbs().maxCoeff(), &exponent);
  Vec3 scaled = v;
  for (int k = 0; k < 3; ++k) scaled[k] = std::ldexp(v[k], -exponent);
  return scaled / std::sqrt(scaled.squaredNorm());
}

}  // namespace

Plane facet_plane(std::span<const Vec3> points, std::span<const std::uint32_t> polygon) {
  const auto [a, b, c] = spread(points, polygon);
  const Vec3 e1 = b - a, e2 = c - a;
  Vec3 normal = e1.cross(e2);
  const double product = e1.squaredNorm() * e2.squaredNorm();
  if (!(normal.squaredNorm() > kThin * kThin * product)) normal = accurate_normal(a, b, c);
  Plane plane;
  plane.n = unit(normal);
  plane.d = plane.n.dot(points[polygon[0]]);
  for (const std::uint32_t p : polygon) plane.d = std::max(plane.d, plane.n.dot(points[p]));
  return plane;
}

}  // namespace osteon::hull
