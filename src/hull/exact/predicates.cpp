#include "exact/predicates.h"

#include <algorithm>
#include <cmath>
#include <initializer_list>

#include "exact/big_int.h"
#include "exact/expansion.h"

namespace osteon::hull {

namespace {

// (7 + 56 u) u and (3 + 16 u) u with u = 2^-53 (Shewchuk 1997, figures 21 and 24), rounded up.
constexpr double kOrient3dBound = 7.8e-16;
constexpr double kOrient2dBound = 3.4e-16;
// The bounds above leave underflow out. With differences below kLargest, what underflow loses stays
// below kUnderflow, and nothing overflows.
constexpr double kLargest = 1e90;
constexpr double kUnderflow = 1e-230;
// A coordinate between these has its lowest bit above 2^-343 and a third power below 2^903, so all
// terms of the expansions are exact. Zero is fine as well.
constexpr double kSmallestExact = 0x1p-290;
constexpr double kLargestExact = 0x1p+300;

bool in_range(double x) {
  return x == 0 || (std::abs(x) >= kSmallestExact && std::abs(x) <= kLargestExact);
}
bool in_range(const Vec3& p) { return in_range(p.x()) && in_range(p.y()) && in_range(p.z()); }

Expansion<2> difference(double a, double b) { return Expansion<2>(two_diff(a, b)); }

/// a0 b1 - a1 b0
Expansion<16> minor(const Expansion<2>& a0, const Expansion<2>& a1, const Expansion<2>& b0,
                    const Expansion<2>& b1) {
  Expansion<16> result;
  result.add(product(a0, b1));
  result.subtract(product(a1, b0));
  return result;
}

int expansion_orient3d(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  Expansion<2> u[3], v[3], w[3];
  for (int k = 0; k < 3; ++k) {
    u[k] = difference(b[k], a[k]);
    v[k] = difference(c[k], a[k]);
    w[k] = difference(d[k], a[k]);
  }
  Expansion<192> det;
  det.add(product(w[2], minor(u[0], u[1], v[0], v[1])));
  det.add(product(w[0], minor(u[1], u[2], v[1], v[2])));
  det.add(product(w[1], minor(u[2], u[0], v[2], v[0])));
  return det.sign();
}

int big_orient3d(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  int e = 2000;
  for (const Vec3* p : {&a, &b, &c, &d}) {
    for (int k = 0; k < 3; ++k) e = std::min(e, lowest_bit((*p)[k]));
  }
  BigInt u[3], v[3], w[3];
  for (int k = 0; k < 3; ++k) {
    const BigInt origin(a[k], e);
    u[k] = BigInt(b[k], e) - origin;
    v[k] = BigInt(c[k], e) - origin;
    w[k] = BigInt(d[k], e) - origin;
  }
  const BigInt det = w[2] * (u[0] * v[1] - u[1] * v[0]) + w[0] * (u[1] * v[2] - u[2] * v[1]) +
                     w[1] * (u[2] * v[0] - u[0] * v[2]);
  return det.sign();
}

int big_orient2d(double ax, double ay, double bx, double by, double cx, double cy) {
  int e = 2000;
  for (const double x : {ax, ay, bx, by, cx, cy}) e = std::min(e, lowest_bit(x));
  const BigInt x(ax, e), y(ay, e);
  const BigInt det =
      (BigInt(bx, e) - x) * (BigInt(cy, e) - y) - (BigInt(by, e) - y) * (BigInt(cx, e) - x);
  return det.sign();
}

double largest(const Vec3& u, const Vec3& v, const Vec3& w) {
  return u.cwiseAbs().cwiseMax(v.cwiseAbs()).cwiseMax(w.cwiseAbs()).maxCoeff();
}

}  // namespace

int orient3d(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d, std::size_t* undecided) {
  const Vec3 u = b - a;
  const Vec3 v = c - a;
  const Vec3 w = d - a;
  const double xy = u.x() * v.y(), yx = u.y() * v.x();
  const double yz = u.y() * v.z(), zy = u.z() * v.y();
  const double zx = u.z() * v.x(), xz = u.x() * v.z();
  const double det = (w.z() * (xy - yx) + w.x() * (yz - zy)) + w.y() * (zx - xz);
  const double permanent = (std::abs(w.z()) * (std::abs(xy) + std::abs(yx)) +
                            std::abs(w.x()) * (std::abs(yz) + std::abs(zy))) +
                           std::abs(w.y()) * (std::abs(zx) + std::abs(xz));
  const double bound = kOrient3dBound * permanent + kUnderflow;
  if (largest(u, v, w) < kLargest) {
    if (det > bound) return 1;
    if (det < -bound) return -1;
  }
  if (undecided) ++*undecided;
  if (in_range(a) && in_range(b) && in_range(c) && in_range(d)) {
    return expansion_orient3d(a, b, c, d);
  }
  return big_orient3d(a, b, c, d);
}

int orient2d(const Vec3& a, const Vec3& b, const Vec3& c, int i, int j, std::size_t* undecided) {
  const double ux = b[i] - a[i], uy = b[j] - a[j];
  const double vx = c[i] - a[i], vy = c[j] - a[j];
  const double left = ux * vy;
  const double right = uy * vx;
  const double bound = kOrient2dBound * (std::abs(left) + std::abs(right)) + kUnderflow;
  const double size = std::max({std::abs(ux), std::abs(uy), std::abs(vx), std::abs(vy)});
  if (size < kLargest) {
    if (left - right > bound) return 1;
    if (left - right < -bound) return -1;
  }
  if (undecided) ++*undecided;
  const bool exact = in_range(a[i]) && in_range(a[j]) && in_range(b[i]) && in_range(b[j]) &&
                     in_range(c[i]) && in_range(c[j]);
  if (!exact) return big_orient2d(a[i], a[j], b[i], b[j], c[i], c[j]);
  return minor(difference(b[i], a[i]), difference(b[j], a[j]), difference(c[i], a[i]),
               difference(c[j], a[j]))
      .sign();
}

bool collinear(const Vec3& a, const Vec3& b, const Vec3& c, std::size_t* undecided) {
  return orient2d(a, b, c, 0, 1, undecided) == 0 && orient2d(a, b, c, 1, 2, undecided) == 0 &&
         orient2d(a, b, c, 2, 0, undecided) == 0;
}

Vec3 accurate_normal(const Vec3& a, const Vec3& b, const Vec3& c) {
  if (!in_range(a) || !in_range(b) || !in_range(c)) return (b - a).cross(c - a);
  Expansion<2> u[3], v[3];
  for (int k = 0; k < 3; ++k) {
    u[k] = difference(b[k], a[k]);
    v[k] = difference(c[k], a[k]);
  }
  return {minor(u[1], u[2], v[1], v[2]).estimate(), minor(u[2], u[0], v[2], v[0]).estimate(),
          minor(u[0], u[1], v[0], v[1]).estimate()};
}

}  // namespace osteon::hull
