#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <vector>

#include "osteon/base/types.h"
#include "osteon/mesh/tri_mesh.h"

namespace osteon::checks {

/// Point of triangle abc nearest to p (Ericson, "Real-Time Collision Detection", 2005, 5.1.5).
inline Vec3 nearest_on_triangle(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 ab = b - a, ac = c - a, ap = p - a, bp = p - b, cp = p - c;
  const double d1 = ab.dot(ap), d2 = ac.dot(ap);
  if (d1 <= 0 && d2 <= 0) return a;
  const double d3 = ab.dot(bp), d4 = ac.dot(bp);
  if (d3 >= 0 && d4 <= d3) return b;
  const double vc = d1 * d4 - d3 * d2;
  if (vc <= 0 && d1 >= 0 && d3 <= 0) return a + d1 / (d1 - d3) * ab;
  const double d5 = ab.dot(cp), d6 = ac.dot(cp);
  if (d6 >= 0 && d5 <= d6) return c;
  const double vb = d5 * d2 - d1 * d6;
  if (vb <= 0 && d2 >= 0 && d6 <= 0) return a + d2 / (d2 - d6) * ac;
  const double va = d3 * d6 - d5 * d4;
  if (va <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0)
    return b + (d4 - d3) / ((d4 - d3) + (d5 - d6)) * (c - b);
  const double scale = 1 / (va + vb + vc);
  return a + ab * (vb * scale) + ac * (vc * scale);
}

/// Distance to a closed surface and whether a point is inside it, by brute force over bins.
class SurfaceProbe {
 public:
  SurfaceProbe(const TriMesh& mesh, const Pose& X_WB) : triangles_(mesh.triangles) {
    for (const Vec3& v : mesh.vertices) {
      vertices_W_.push_back(X_WB * v);
      box_W_.include(vertices_W_.back());
    }
    for (std::size_t i = 0; i < triangles_.size(); ++i) {
      Aabb b;
      for (const std::uint32_t v : triangles_[i]) b.include(vertices_W_[v]);
      for (int x = bin(b.lo.x()); x <= bin(b.hi.x()); ++x)
        for (int y = bin(b.lo.y()); y <= bin(b.hi.y()); ++y) {
          for (int z = bin(b.lo.z()); z <= bin(b.hi.z()); ++z) near_[{x, y, z}].push_back(i);
        }
      for (int y = bin(b.lo.y()); y <= bin(b.hi.y()); ++y)
        for (int z = bin(b.lo.z()); z <= bin(b.hi.z()); ++z) column_[{y, z}].push_back(i);
    }
  }

  const std::vector<Vec3>& vertices_W() const { return vertices_W_; }
  const Aabb& box_W() const { return box_W_; }

  /// Distance, or `limit` where the surface is farther.
  double distance(const Vec3& p, double limit) const {
    double best = limit;
    for (int x = bin(p.x() - limit); x <= bin(p.x() + limit); ++x)
      for (int y = bin(p.y() - limit); y <= bin(p.y() + limit); ++y)
        for (int z = bin(p.z() - limit); z <= bin(p.z() + limit); ++z) {
          const auto found = near_.find({x, y, z});
          if (found == near_.end()) continue;
          for (const std::size_t i : found->second) {
            const Triangle& t = triangles_[i];
            const Vec3 q =
                nearest_on_triangle(p, vertices_W_[t[0]], vertices_W_[t[1]], vertices_W_[t[2]]);
            best = std::min(best, (p - q).norm());
          }
        }
    return best;
  }

  /// Parity of crossings along +x; the ray is moved a little off the grid.
  bool inside(const Vec3& point) const {
    const Vec3 p = point + Vec3(0, 1.7e-9, 3.1e-9);
    const auto found = column_.find({bin(p.y()), bin(p.z())});
    if (found == column_.end()) return false;
    bool odd = false;
    for (const std::size_t i : found->second) {
      const Triangle& t = triangles_[i];
      if (crosses(p, vertices_W_[t[0]], vertices_W_[t[1]], vertices_W_[t[2]])) odd = !odd;
    }
    return odd;
  }

 private:
  static int bin(double x) { return static_cast<int>(std::floor(x / 0.002)); }
  static bool crosses(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c) {
    const auto side = [&p](const Vec3& u, const Vec3& v) {
      return (v.y() - u.y()) * (p.z() - u.z()) - (v.z() - u.z()) * (p.y() - u.y());
    };
    const double ab = side(a, b), bc = side(b, c), ca = side(c, a), sum = ab + bc + ca;
    if (!((ab > 0 && bc > 0 && ca > 0) || (ab < 0 && bc < 0 && ca < 0))) return false;
    return (bc * a.x() + ca * b.x() + ab * c.x()) / sum > p.x();
  }

  std::vector<Triangle> triangles_;
  std::vector<Vec3> vertices_W_;
  Aabb box_W_;
  std::map<std::array<int, 3>, std::vector<std::size_t>> near_;
  std::map<std::array<int, 2>, std::vector<std::size_t>> column_;
};

}  // namespace osteon::checks
