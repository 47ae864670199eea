#pragma once

// Hit or miss of two posed hulls, decided with integers alone. A hull is the convex hull of its
// vertices; B is posed by the rotation v -> (q v q*) / |q|^2, which is exact for any quaternion, so
// that no rounding enters. Inputs lie on a grid (snapped by the functions below).

#include <boost/multiprecision/cpp_int.hpp>
#include <cmath>
#include <vector>

#include "osteon/base/types.h"
#include "osteon/hull/hull.h"

namespace osteon::exact {

namespace mp = boost::multiprecision;
// Widest product: facet normal (2 x 58 bits) x |q|^2 (108) x coordinate (60), well below 512.
// Checked: an overflow throws.
using Int = mp::number<mp::cpp_int_backend<512, 512, mp::signed_magnitude, mp::checked, void>>;

struct IVec {
  Int x, y, z;
};
inline IVec operator-(const IVec& a, const IVec& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
inline IVec operator+(const IVec& a, const IVec& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
inline Int dot(const IVec& a, const IVec& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline IVec cross(const IVec& a, const IVec& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

inline constexpr int kLengthBits = 60;  // lengths are multiples of 2^-60 m
inline constexpr int kTurnBits = 53;    // quaternions and directions are multiples of 2^-53

inline double snap(double value, int bits) {
  return std::ldexp(std::nearbyint(std::ldexp(value, bits)), -bits);
}
inline Vec3 snap(const Vec3& v, int bits) {
  return {snap(v.x(), bits), snap(v.y(), bits), snap(v.z(), bits)};
}
inline Pose snap(const Pose& X) {
  return {snap(X.p, kLengthBits), Quat(snap(X.q.w(), kTurnBits), snap(X.q.x(), kTurnBits),
                                       snap(X.q.y(), kTurnBits), snap(X.q.z(), kTurnBits))};
}

/// `v` must lie on the grid.
inline IVec integer(const Vec3& v, int bits) {
  const auto one = [&](double x) { return Int(std::llrint(std::ldexp(x, bits))); };
  return {one(v.x()), one(v.y()), one(v.z())};
}

/// A hull with integer vertices and facets n.x <= d.
struct Body {
  std::vector<IVec> vertices;
  std::vector<IVec> normals;
  std::vector<Int> offsets;
};

inline Body body(const Hull& hull) {
  Body b;
  for (const Vec3& v : hull.vertices) b.vertices.push_back(integer(v, kLengthBits));
  for (const Triangle& t : hull.triangles) {
    const IVec& v = b.vertices[t[0]];
    b.normals.push_back(cross(b.vertices[t[1]] - v, b.vertices[t[2]] - v));
    b.offsets.push_back(dot(b.normals.back(), v));
  }
  return b;
}

/// Every vertex on or below every facet's plane: with a closed surface the facets are the hull's.
inline bool is_convex(const Body& b) {
  for (std::size_t f = 0; f < b.normals.size(); ++f)
    for (const IVec& v : b.vertices)
      if (dot(b.normals[f], v) > b.offsets[f]) return false;
  return true;
}

/// Pose with integer entries: x_A = (R x_B) / norm + p.
struct Turn {
  IVec rows[3];
  Int norm;
  IVec p;

  explicit Turn(const Pose& X) : p(integer(X.p, kLengthBits)) {
    const auto whole = [](double x) { return Int(std::llrint(std::ldexp(x, kTurnBits))); };
    const Int w = whole(X.q.w()), x = whole(X.q.x()), y = whole(X.q.y()), z = whole(X.q.z());
    norm = w * w + x * x + y * y + z * z;
    rows[0] = {w * w + x * x - y * y - z * z, 2 * (x * y - w * z), 2 * (x * z + w * y)};
    rows[1] = {2 * (x * y + w * z), w * w - x * x + y * y - z * z, 2 * (y * z - w * x)};
    rows[2] = {2 * (x * z - w * y), 2 * (y * z + w * x), w * w - x * x - y * y + z * z};
  }
  IVec turn(const IVec& v) const { return {dot(rows[0], v), dot(rows[1], v), dot(rows[2], v)}; }
  IVec turn_back(const IVec& v) const {
    return {rows[0].x * v.x + rows[1].x * v.y + rows[2].x * v.z,
            rows[0].y * v.x + rows[1].y * v.y + rows[2].y * v.z,
            rows[0].z * v.x + rows[1].z * v.y + rows[2].z * v.z};
  }
};

/// Proof of a hit: `p_A`, snapped to the grid, lies in both bodies.
inline bool proves_hit(const Body& a, const Body& b, const Turn& X_AB, const Vec3& p_A) {
  const IVec x = integer(snap(p_A, kLengthBits), kLengthBits);
  for (std::size_t f = 0; f < a.normals.size(); ++f)
    if (dot(a.normals[f], x) > a.offsets[f]) return false;
  const IVec y = X_AB.turn_back(x - X_AB.p);  // norm times the point in B
  for (std::size_t f = 0; f < b.normals.size(); ++f)
    if (dot(b.normals[f], y) > X_AB.norm * b.offsets[f]) return false;
  return true;
}

/// Proof of a miss: every vertex of B is further along `n_A` than every vertex of A.
inline bool proves_miss(const Body& a, const Body& b, const Turn& X_AB, const Vec3& n_A) {
  const IVec n = integer(snap(n_A, kTurnBits), kTurnBits);
  Int top = dot(n, a.vertices.front());
  for (const IVec& v : a.vertices) {
    const Int h = dot(n, v);
    if (h > top) top = h;
  }
  top = X_AB.norm * (top - dot(n, X_AB.p));
  const IVec m = X_AB.turn_back(n);
  for (const IVec& v : b.vertices)
    if (dot(m, v) <= top) return false;
  return true;
}

}  // namespace osteon::exact
