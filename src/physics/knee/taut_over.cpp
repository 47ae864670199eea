#include "knee/taut_over.h"

#include <algorithm>
#include <utility>
#include <vector>

namespace osteon {
namespace {

using Vec2 = Eigen::Vector2d;

double turn_of(const Vec2& a, const Vec2& b, const Vec2& c) {
  return (b.x() - a.x()) * (c.y() - a.y()) - (b.y() - a.y()) * (c.x() - a.x());
}

/// Where edges of the mesh cross the plane through `from`, in its axes along and out.
std::vector<Vec2> crossings(const TriMesh& bone, const Vec3& from, const Vec3& along,
                            const Vec3& out) {
  const Vec3 normal = along.cross(out);
  std::vector<Vec2> points;
  for (const Triangle& t : bone.triangles)
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3 a = bone.vertices[t[k]] - from, b = bone.vertices[t[(k + 1) % 3]] - from;
      const double ha = a.dot(normal), hb = b.dot(normal);
      if ((ha < 0) == (hb < 0)) continue;
      const Vec3 p = a + (b - a) * (ha / (ha - hb));
      points.emplace_back(p.dot(along), p.dot(out));
    }
  return points;
}

/// Upper convex hull from the first point to the last, of points sorted along x.
std::vector<Vec2> upper_hull(const std::vector<Vec2>& sorted) {
  std::vector<Vec2> hull;
  for (const Vec2& p : sorted) {
    while (hull.size() >= 2 && turn_of(hull[hull.size() - 2], hull.back(), p) >= 0) hull.pop_back();
    hull.push_back(p);
  }
  return hull;
}

}  // namespace

TautOver taut_over(const TriMesh& bone, const Vec3& from, const Vec3& to, const Vec3& outward) {
  // In the plane: x along the string, y outwards. The string is the upper hull of both ends and of
  // what of the section stands above the straight line (Andrew 1979, monotone chain).
  const double length = (to - from).norm();
  const Vec3 along = (to - from) / length;
  const Vec3 out = (outward - outward.dot(along) * along).normalized();
  std::vector<Vec2> points{{0, 0}, {length, 0}};
  for (const Vec2& p : crossings(bone, from, along, out))
    if (p.x() > 0 && p.x() < length && p.y() > 0) points.push_back(p);
  std::sort(points.begin(), points.end(), [](const Vec2& a, const Vec2& b) {
    return std::pair(a.x(), a.y()) < std::pair(b.x(), b.y());
  });
  const std::vector<Vec2> hull = upper_hull(points);
  TautOver taut;
  taut.first = from + hull[1].x() * along + hull[1].y() * out;
  for (std::size_t i = 1; i + 1 < hull.size(); ++i) taut.rest_m += (hull[i + 1] - hull[i]).norm();
  return taut;
}

}  // namespace osteon
