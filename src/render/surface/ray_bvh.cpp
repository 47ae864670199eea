#include "surface/ray_bvh.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace osteon {
namespace {

constexpr std::uint32_t kLeafFaces = 4;
constexpr int kMaxDepth = 48;

/// Slab test; `inv` is one over the direction (infinite where that is zero). Returns the entry
/// distance, or infinity for a miss. The order of min and max drops the NaN of 0 * infinity.
double entry(const Aabb& box, const Vec3& origin, const Vec3& inv, double t_max) {
  double near = 0;
  double far = t_max;
  for (int k = 0; k < 3; ++k) {
    const double a = (box.lo[k] - origin[k]) * inv[k];
    const double b = (box.hi[k] - origin[k]) * inv[k];
    near = std::max(near, std::min(a, b));
    far = std::min(far, std::max(a, b));
  }
  return near <= far ? near : std::numeric_limits<double>::infinity();
}

}  // namespace

RayBvh::RayBvh(std::span<const Vec3> vertices, std::span<const Triangle> triangles) {
  faces_.reserve(triangles.size());
  for (std::size_t k = 0; k < triangles.size(); ++k) {
    const Triangle& t = triangles[k];
    if (std::max({t[0], t[1], t[2]}) >= vertices.size()) continue;
    const Vec3 &a = vertices[t[0]], &b = vertices[t[1]], &c = vertices[t[2]];
    if (!is_finite(a) || !is_finite(b) || !is_finite(c)) continue;
    faces_.push_back({a, b - a, c - a, static_cast<std::uint32_t>(k)});
  }
  if (faces_.empty()) return;
  nodes_.reserve(faces_.size());
  nodes_.push_back({{}, 0, static_cast<std::uint32_t>(faces_.size())});
  split(0, 0);
}

void RayBvh::split(std::uint32_t node, int depth) {
  const std::uint32_t first = nodes_[node].first, count = nodes_[node].count;
  Aabb box, centers;
  for (std::uint32_t k = first; k < first + count; ++k) {
    const Face& f = faces_[k];
    for (const Vec3& p : {f.a, Vec3(f.a + f.ab), Vec3(f.a + f.ac)}) box.include(p);
    centers.include(f.a + (f.ab + f.ac) / 3);
  }
  nodes_[node].box = box.grown(1e-12);  // flat boxes stay hittable after rounding
  if (count <= kLeafFaces || depth >= kMaxDepth) return;
  int axis = 0;
  centers.extent().maxCoeff(&axis);
  // Median by centre, equal centres by triangle: the tree does not depend on the library's sort.
  const auto begin = faces_.begin() + first;
  const auto key = [axis](const Face& f) { return f.a[axis] + (f.ab[axis] + f.ac[axis]) / 3; };
  std::nth_element(begin, begin + count / 2, begin + count, [&](const Face& p, const Face& q) {
    const double a = key(p), b = key(q);
    return a != b ? a < b : p.triangle < q.triangle;
  });
  const auto left = static_cast<std::uint32_t>(nodes_.size());
  nodes_.push_back({{}, first, count / 2});
  nodes_.push_back({{}, first + count / 2, count - count / 2});
  nodes_[node].first = left;
  nodes_[node].count = 0;
  split(left, depth + 1);
  split(left + 1, depth + 1);
}

std::optional<RayHit> RayBvh::closest(const Vec3& origin, const Vec3& dir, double t_max) const {
  if (nodes_.empty() || !is_finite(origin) || !is_finite(dir)) return std::nullopt;
  const Vec3 inv = dir.cwiseInverse();
  std::array<std::uint32_t, kMaxDepth + 2> stack;
  std::size_t top = 0;
  stack[top++] = 0;
  RayHit best{t_max, 0};
  bool found = false;
  while (top > 0) {
    const Node& node = nodes_[stack[--top]];
    if (!(entry(node.box, origin, inv, best.t) < best.t)) continue;
    if (node.count == 0) {
      const bool left_first = entry(nodes_[node.first].box, origin, inv, best.t) <=
                              entry(nodes_[node.first + 1].box, origin, inv, best.t);
      stack[top++] = node.first + (left_first ? 1 : 0);
      stack[top++] = node.first + (left_first ? 0 : 1);
      continue;
    }
    // Moller and Trumbore 1997.
    for (std::uint32_t k = node.first; k < node.first + node.count; ++k) {
      const Face& f = faces_[k];
      const Vec3 h = dir.cross(f.ac);
      const double det = f.ab.dot(h);
      if (det == 0) continue;
      const Vec3 s = origin - f.a;
      const double u = s.dot(h) / det;
      if (!(u >= 0 && u <= 1)) continue;
      const Vec3 q = s.cross(f.ab);
      const double v = dir.dot(q) / det;
      if (!(v >= 0 && u + v <= 1)) continue;
      const double t = f.ac.dot(q) / det;
      if (t > 0 && t < best.t) {
        best = {t, f.triangle};
        found = true;
      }
    }
  }
  return found ? std::optional<RayHit>(best) : std::nullopt;
}

}  // namespace osteon
