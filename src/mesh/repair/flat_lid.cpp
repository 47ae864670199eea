#include "repair/flat_lid.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace osteon {
namespace {

constexpr double kMostStray = 0.1;  // of the rim's width

// Twice the area vector of the polygon (Newell); along it the polygon runs counter-clockwise.
Vec3 newell(const std::vector<Vec3>& corners) {
  Vec3 sum = Vec3::Zero();
  for (std::size_t i = 0; i < corners.size(); ++i)
    sum += (corners[i] - corners[0]).cross(corners[(i + 1) % corners.size()] - corners[0]);
  return sum;
}

bool lie_flat(const std::vector<Vec3>& corners, const Vec3& normal) {
  Vec3 middle = Vec3::Zero();
  for (const Vec3& c : corners) middle += c / static_cast<double>(corners.size());
  double stray = 0, width = 0;
  for (const Vec3& c : corners) {
    stray = std::max(stray, std::abs(normal.dot(c - middle)));
    width = std::max(width, (c - middle).norm());
  }
  return stray <= kMostStray * 2 * width;
}

// Symbols: the corners projected to the plane; `next_` and `before_` link those that are left.
// Invariant: what is left is a polygon that runs counter-clockwise, and with the ears taken it
// covers the first one. Source: Meisters, "Polygons have ears" (1975): a simple polygon has two
// ears, so one is always found. It ends: each round takes a corner, or gives up after it has looked
// at all of them in vain (a rim that crosses itself).
class EarClipping {
 public:
  EarClipping(const std::vector<Vec3>& corners, const Vec3& normal)
      : next_(corners.size()), before_(corners.size()) {
    const Vec3 any = std::abs(normal.x()) < 0.7 ? Vec3::UnitX() : Vec3::UnitY();
    const Vec3 u = normal.cross(any).normalized();
    const Vec3 v = normal.cross(u);
    for (const Vec3& c : corners) at_.push_back({u.dot(c), v.dot(c)});
    const std::size_t n = corners.size();
    for (std::size_t i = 0; i < n; ++i) {
      next_[i] = (i + 1) % n;
      before_[i] = (i + n - 1) % n;
    }
  }

  template <class MayJoin>
  bool run(const MayJoin& may_join) {
    std::size_t left = at_.size(), in_vain = 0, i = 0;
    while (left > 3 && in_vain <= left) {
      const std::size_t a = before_[i], c = next_[i];
      if (is_ear(a, i, c) && may_join(a, c)) {
        ears.push_back({a, i, c});
        next_[a] = c;
        before_[c] = a;
        --left;
        in_vain = 0;
      } else {
        ++in_vain;
      }
      i = c;
    }
    if (left > 3) return false;
    ears.push_back({before_[i], i, next_[i]});
    return true;
  }

  std::vector<std::array<std::size_t, 3>> ears;

 private:
  using Point = std::array<double, 2>;
  // Twice the area of a triangle, positive counter-clockwise.
  double turn(std::size_t a, std::size_t b, std::size_t c) const {
    const Point &p = at_[a], &q = at_[b], &r = at_[c];
    return (q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0]);
  }
  bool is_ear(std::size_t a, std::size_t b, std::size_t c) const {
    if (!(turn(a, b, c) > 0)) return false;
    for (std::size_t p = next_[c]; p != a; p = next_[p])
      if (turn(a, b, p) >= 0 && turn(b, c, p) >= 0 && turn(c, a, p) >= 0) return false;
    return true;
  }

  std::vector<Point> at_;
  std::vector<std::size_t> next_, before_;
};

}  // namespace

std::vector<Triangle> flat_lid(const std::vector<Vec3>& vertices,
                               const std::vector<std::uint32_t>& loop,
                               const std::function<bool(std::uint32_t, std::uint32_t)>& may_join) {
  if (loop.size() < 3) return {};
  std::vector<Vec3> corners;
  for (const std::uint32_t v : loop) corners.push_back(vertices[v]);
  const Vec3 area = newell(corners);
  if (!(area.norm() > 0) || !lie_flat(corners, area.normalized())) return {};
  EarClipping clipping(corners, area.normalized());
  if (!clipping.run([&](std::size_t a, std::size_t b) { return may_join(loop[a], loop[b]); }))
    return {};
  std::vector<Triangle> lid;
  for (const auto& [a, b, c] : clipping.ears) lid.push_back({loop[a], loop[b], loop[c]});
  return lid;
}

}  // namespace osteon
