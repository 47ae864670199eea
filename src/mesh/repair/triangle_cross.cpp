#include "repair/triangle_cross.h"

#include <algorithm>
#include <cmath>

namespace osteon {
namespace {

/// Six times the volume of abcd, or 0 where rounding could have changed its sign.
double orient(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  const Vec3 u = a - d, v = b - d, w = c - d;
  const double det = u.dot(v.cross(w));
  const Vec3 au = u.cwiseAbs(), av = v.cwiseAbs(), aw = w.cwiseAbs();
  const Vec3 bound(av.y() * aw.z() + av.z() * aw.y(), av.z() * aw.x() + av.x() * aw.z(),
                   av.x() * aw.y() + av.y() * aw.x());
  return std::abs(det) > 1e-15 * au.dot(bound) ? det : 0;
}

/// True when the inside of segment pq passes through the inside of abc, or plainly through the
/// inside of one of its edges, where the surface goes on with the next triangle: two boxes whose
/// edges meet the other's diagonals cross nowhere else. Of what lies almost in one plane, rounding
/// decides on which side of an edge it passes, so that counts only in the inside.
bool pierces(const Vec3& p, const Vec3& q, const Vec3& a, const Vec3& b, const Vec3& c) {
  constexpr double kPlain = 1e-6;  // of the product of the lengths
  const double at_p = orient(a, b, c, p), at_q = orient(a, b, c, q);
  if (!(at_p > 0 && at_q < 0) && !(at_p < 0 && at_q > 0)) return false;
  const double u = orient(p, q, a, b), v = orient(p, q, b, c), w = orient(p, q, c, a);
  if ((u > 0 && v > 0 && w > 0) || (u < 0 && v < 0 && w < 0)) return true;
  const int on_edges = (u == 0) + (v == 0) + (w == 0);
  if (on_edges != 1) return false;
  const double plain = kPlain * (b - a).norm() * (c - a).norm() * (q - p).norm();
  if (std::min(std::abs(at_p), std::abs(at_q)) < plain) return false;
  return (u >= 0 && v >= 0 && w >= 0) || (u <= 0 && v <= 0 && w <= 0);
}

bool has(const Triangle& t, std::uint32_t v) { return t[0] == v || t[1] == v || t[2] == v; }

/// True when `b`, but for the corners that it has in common with `a`, surely lies on one side of
/// the plane of `a`: then the two have no more than these in common.
bool beside(const std::vector<Vec3>& p, const Triangle& a, const Triangle& b) {
  bool above = false, below = false;
  for (const std::uint32_t v : b) {
    if (has(a, v)) continue;
    const double side = orient(p[a[0]], p[a[1]], p[a[2]], p[v]);
    above = above || side >= 0;
    below = below || side <= 0;
    if (above && below) return false;
  }
  return true;
}

/// An edge of `a` through `b`, of the edges that share no corner with it.
bool edge_pierces(const std::vector<Vec3>& p, const Triangle& a, const Triangle& b) {
  for (std::size_t k = 0; k < 3; ++k) {
    const std::uint32_t from = a[k], to = a[(k + 1) % 3];
    if (has(b, from) || has(b, to)) continue;
    if (pierces(p[from], p[to], p[b[0]], p[b[1]], p[b[2]])) return true;
  }
  return false;
}

/// Two triangles on one edge, in one plane, on the same side of it.
bool folded(const std::vector<Vec3>& p, const Triangle& a, const Triangle& b) {
  for (std::size_t k = 0; k < 3; ++k) {
    if (has(b, a[k])) continue;
    const Vec3 &from = p[a[(k + 1) % 3]], &to = p[a[(k + 2) % 3]];
    for (const std::uint32_t other : b) {
      if (has(a, other)) continue;
      const Vec3 n = (to - from).cross(p[a[k]] - from), m = (to - from).cross(p[other] - from);
      return orient(from, to, p[a[k]], p[other]) == 0 && n.dot(m) > 0;
    }
  }
  return false;
}

/// Two overlapping triangles in one plane that share nothing or a corner.
bool overlap_in_plane(const std::vector<Vec3>& p, const Triangle& a, const Triangle& b) {
  for (const std::uint32_t v : b)
    if (orient(p[a[0]], p[a[1]], p[a[2]], p[v]) != 0) return false;
  const Vec3 n = (p[a[1]] - p[a[0]]).cross(p[a[2]] - p[a[0]]);
  const Vec3 m = (p[b[1]] - p[b[0]]).cross(p[b[2]] - p[b[0]]);
  // Parted by a line along one of the six edges; the least room that counts as overlap is rounding.
  const auto parted_by = [&](const Triangle& t, const Triangle& other, const Vec3& normal) {
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3 outward = (p[t[(k + 1) % 3]] - p[t[k]]).cross(normal);
      const double room = 1e-12 * outward.norm() * (p[t[0]] - p[t[1]]).norm();
      bool all = true;
      for (const std::uint32_t v : other) all = all && outward.dot(p[v] - p[t[k]]) >= -room;
      if (all) return true;
    }
    return false;
  };
  return n.squaredNorm() > 0 && m.squaredNorm() > 0 && !parted_by(a, b, n) && !parted_by(b, a, m);
}

}  // namespace

bool triangles_cross(const std::vector<Vec3>& vertices, const Triangle& a, const Triangle& b) {
  const auto shared =
      std::count_if(a.begin(), a.end(), [&b](std::uint32_t v) { return has(b, v); });
  if (shared == 3) return true;
  if (shared == 2) return folded(vertices, a, b);
  if (beside(vertices, a, b) || beside(vertices, b, a)) return false;
  return edge_pierces(vertices, a, b) || edge_pierces(vertices, b, a) ||
         overlap_in_plane(vertices, a, b);
}

}  // namespace osteon
