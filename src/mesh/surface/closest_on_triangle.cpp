#include "surface/closest_on_triangle.h"

#include <algorithm>
#include <limits>

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

// Keeps the nearer of two places, whose squared distance is known.
void take_nearer(const TrianglePoint& side, const Vec3& p, TrianglePoint& best, double& squared) {
  const double there = (side.point - p).squaredNorm();
  if (!(there < squared)) return;
  best = side;
  squared = there;
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
  if (has_area && u > 0 && v > 0 && w > 0)
    return {a + v / area2 * ab + w / area2 * ac, Part::kFace};
  // The nearest place is on a side that the projection lies beyond. Where rounding may have chosen
  // another, all sides count.
  const bool sure = area2 > 1e-6 * longest * longest;
  const double inside = sure ? 1e-6 * area2 : std::numeric_limits<double>::infinity();
  TrianglePoint best{a, Part::kCorner0};
  double squared = std::numeric_limits<double>::infinity();
  if (!(w > inside))
    take_nearer(closest_on_side(p, a, b, Part::kEdge0, Part::kCorner0, Part::kCorner1), p, best,
                squared);
  if (!(u > inside))
    take_nearer(closest_on_side(p, b, c, Part::kEdge1, Part::kCorner1, Part::kCorner2), p, best,
                squared);
  if (!(v > inside))
    take_nearer(closest_on_side(p, c, a, Part::kEdge2, Part::kCorner2, Part::kCorner0), p, best,
                squared);
  return best;
}

}  // namespace osteon
