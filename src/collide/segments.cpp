#include "osteon/collide/segments.h"

#include <algorithm>

namespace osteon {

// Symbols: the points are a.p0 + s u and b.p0 + t v. The unbounded minimum in s is clamped to the
// segment, then t is the best for it, clamped, and where that moved it s once more: the distance is
// convex in (s, t), so that the last step ends at the minimum over the square.
AxisPoints nearest_on_axes(const Capsule& a, const Capsule& b) {
  constexpr double kParallel = 1e-12;
  const auto clamped = [](double x) { return std::clamp(x, 0.0, 1.0); };
  const Vec3 u = a.p1 - a.p0;
  const Vec3 v = b.p1 - b.p0;
  const Vec3 w = a.p0 - b.p0;
  const double uu = u.squaredNorm(), vv = v.squaredNorm();
  const double uv = u.dot(v), uw = u.dot(w), vw = v.dot(w);
  const double det = uu * vv - uv * uv;
  double s = det > kParallel * uu * vv ? clamped((uv * vw - uw * vv) / det) : 0;
  const double t = vv > 0 ? clamped((uv * s + vw) / vv) : 0;
  s = uu > 0 ? clamped((uv * t - uw) / uu) : 0;
  return {a.p0 + s * u, b.p0 + t * v};
}

}  // namespace osteon
