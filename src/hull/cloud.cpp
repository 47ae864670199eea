#include "cloud.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "predicates.h"

namespace osteon::hull {

namespace {

/// Power of two that brings `half_extent` into [0.5, 1), as far as doubles reach.
double scale_of(double half_extent) {
  int exponent = 0;
  std::frexp(half_extent, &exponent);
  return std::ldexp(1.0, std::clamp(-exponent, -1000, 1000));
}

}  // namespace

Cloud::Cloud(std::span<const Vec3> points) : raw_(points), scaled_(points.size()) {
  if (points.empty()) return;
  Vec3 lo = points[0], hi = points[0];
  for (const Vec3& p : points) {
    lo = lo.cwiseMin(p);
    hi = hi.cwiseMax(p);
  }
  const Vec3 half = 0.5 * hi - 0.5 * lo;
  scale_ = scale_of(half.maxCoeff());
  centre_ = scale_ * (0.5 * lo + 0.5 * hi);
  for (std::size_t i = 0; i < points.size(); ++i) scaled_[i] = to_scaled(points[i]);
}

Cloud::Cloud(const Cloud& from, std::span<const std::uint32_t> order)
    : scale_(from.scale_), centre_(from.centre_) {
  own_.reserve(order.size());
  scaled_.reserve(order.size());
  for (const std::uint32_t i : order) {
    own_.push_back(from.raw(i));
    scaled_.push_back(from.scaled(i));
  }
  raw_ = own_;
}

// Error of a height, with u = 2^-53 and frame S at most 1 + u from its centre: each coordinate is
// off by u, an edge by 4 u, so a component of e1 x e2 by 14 u (|e1| + |e2|) at most; times a vector
// of components up to 2, that is 84 u (|e1| + |e2|). Rounding in the dot products and in the
// normalisation adds 12 u |n| + 14 u |n|. All divided by |n|; the constants are rounded up.
FilterPlane filter_plane(const Vec3& a_S, const Vec3& b_S, const Vec3& c_S) {
  const Vec3 e1 = b_S - a_S;
  const Vec3 e2 = c_S - a_S;
  FilterPlane plane;
  const double nx = e1.y() * e2.z() - e1.z() * e2.y();
  const double ny = e1.z() * e2.x() - e1.x() * e2.z();
  const double nz = e1.x() * e2.y() - e1.y() * e2.x();
  const double square = (nx * nx + ny * ny) + nz * nz;
  if (!(square > 1e-280)) {
    plane.bound = std::numeric_limits<double>::infinity();
    return plane;
  }
  const double inverse = 1.0 / std::sqrt(square);
  plane.nx = nx * inverse;
  plane.ny = ny * inverse;
  plane.nz = nz * inverse;
  plane.d = plane.height(a_S);
  const double edges = std::max({std::abs(e1.x()), std::abs(e1.y()), std::abs(e1.z())}) +
                       std::max({std::abs(e2.x()), std::abs(e2.y()), std::abs(e2.z())});
  plane.bound = 1.2e-14 * edges * inverse + 5e-15;
  return plane;
}

FilterPlane Cloud::plane(std::uint32_t a, std::uint32_t b, std::uint32_t c) const {
  return filter_plane(scaled_[a], scaled_[b], scaled_[c]);
}

int Cloud::exact_side(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t p) const {
  return orient3d(raw_[a], raw_[b], raw_[c], raw_[p], &exact_tests_);
}

}  // namespace osteon::hull
