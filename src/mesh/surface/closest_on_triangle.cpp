#include "surface/closest_on_triangle.h"

#include <algorithm>

namespace osteon {
namespace {

using Part = TrianglePart;

TrianglePoint closest_on_side(const Vec3& p, const Vec3& a, const Vec3& b, Part edge, Part from,
                              Part to) {
  const Vec3 ab = b - a;
  const double along = ab.dot(p - a);
  const double whole = ab.squaredNorm();
  if (!(along > 0)) return {a, from};
  if (!(along < whole)) return {b, to};
  return {a + along / whole * ab, edge};
}

TrianglePoint closest_on_sides(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c) {
  const TrianglePoint sides[] = {
      closest_on_side(p, a, b, Part::kEdge0, Part::kCorner0, Part::kCorner1),
      closest_on_side(p, b, c, Part::kEdge1, Part::kCorner1, Part::kCorner2),
      closest_on_side(p, c, a, Part::kEdge2, Part::kCorner2, Part::kCorner0)};
  TrianglePoint best = sides[0];
  for (const TrianglePoint& side : sides)
    if ((side.point - p).squaredNorm() < (best.point - p).squaredNorm()) best = side;
  return best;
}

}  // namespace

TrianglePoint closest_on_triangle(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 ab = b - a;
  const Vec3 ac = c - a;
  const Vec3 n = ab.cross(ac);
  const double area2 = n.squaredNorm();
  // Barycentric coordinates of the projection, times area2; the face where all are positive.
  const Vec3 ap = p - a;
  const double v = n.dot(ap.cross(ac));
  const double w = n.dot(ab.cross(ap));
  const double u = area2 - v - w;
  const double longest = std::max(ab.squaredNorm(), ac.squaredNorm());
  const bool has_area = area2 > 1e-24 * longest * longest;
  if (!has_area || u <= 0 || v <= 0 || w <= 0) return closest_on_sides(p, a, b, c);
  return {a + v / area2 * ab + w / area2 * ac, Part::kFace};
}

}  // namespace osteon
