#include "cloud.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "exact/predicates.h"

namespace osteon::hull {

double scale_to_one(double half_extent) {
  int exponent = 0;
  std::frexp(half_extent, &exponent);
  return std::ldexp(1.0, std::clamp(-exponent, -1024, 1000));
}

Aabb finite_box(std::span<const Vec3> points) {
  if (points.empty()) return {};
  Vec3 lo = points[0], hi = points[0];
  double spoilt = 0;  // becomes not a number with the first coordinate that is not finite
  for (const Vec3& p : points) {
    for (int k = 0; k < 3; ++k) {
      lo[k] = p[k] < lo[k] ? p[k] : lo[k];
      hi[k] = p[k] > hi[k] ? p[k] : hi[k];
    }
    spoilt += 0 * p.x() + 0 * p.y() + 0 * p.z();
  }
  return spoilt == 0 ? Aabb{lo, hi} : Aabb{};
}

Cloud::Cloud(std::span<const Vec3> points, const Aabb& box) : raw_(points), box_(box) {
  const Vec3 half = 0.5 * box.hi - 0.5 * box.lo;
  scale_ = scale_to_one(half.maxCoeff());
  centre_ = scale_ * (0.5 * box.lo + 0.5 * box.hi);
}

// Error of a height, with u = 2^-53 and frame S at most 1 + u from its centre: each coordinate is
// off by u, an edge by 4 u, so a component of e1 x e2 by 14 u (|e1| + |e2|) at most; times a vector
// of components up to 2, that is 84 u (|e1| + |e2|). Rounding in the dot products and in the
// normalisation adds 12 u |n| + 14 u |n|. All divided by |n|; the constants are rounded up.
FilterPlane Cloud::plane(std::uint32_t a, std::uint32_t b, std::uint32_t c) const {
  const Vec3 a_S = scaled(a);
  const Vec3 e1 = scaled(b) - a_S;
  const Vec3 e2 = scaled(c) - a_S;
  const Vec3 normal = e1.cross(e2);
  FilterPlane plane;
  const double square = normal.squaredNorm();
  if (!(square > 1e-280)) {
    plane.bound = std::numeric_limits<double>::infinity();
    return plane;
  }
  const double inverse = 1.0 / std::sqrt(square);
  plane.nx = normal.x() * inverse;
  plane.ny = normal.y() * inverse;
  plane.nz = normal.z() * inverse;
  plane.d = plane.height(a_S);
  const double edges = e1.cwiseAbs().maxCoeff() + e2.cwiseAbs().maxCoeff();
  plane.bound = 1.2e-14 * edges * inverse + 5e-15;
  return plane;
}

int Cloud::exact_side(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t p) const {
  return orient3d(raw_[a], raw_[b], raw_[c], raw_[p], &exact_tests_);
}

}  // namespace osteon::hull
