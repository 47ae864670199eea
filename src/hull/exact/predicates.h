#pragma once

#include <cstddef>

#include "osteon/base/types.h"

namespace osteon::hull {

/// Sign of ((b - a) x (c - a)) . (d - a), exact for all finite input: +1 when d lies on the side
/// from which a, b, c run counter-clockwise, 0 when the four lie in one plane. A floating-point
/// filter decides the clear cases (Shewchuk 1997, section 4.3); the others are counted in
/// `*undecided` and computed without rounding.
int orient3d(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d,
             std::size_t* undecided = nullptr);

/// The same in the plane of the coordinates `i` and `j`: +1 when a, b, c turn from axis i to j.
int orient2d(const Vec3& a, const Vec3& b, const Vec3& c, int i, int j,
             std::size_t* undecided = nullptr);

/// Whether the three points lie on one line; exact.
bool collinear(const Vec3& a, const Vec3& b, const Vec3& c, std::size_t* undecided = nullptr);

/// (b - a) x (c - a), each component rounded from its exact value: the direction is good to
/// rounding however thin the triangle. Needs coordinates whose products stay in range, else it
/// falls back on plain arithmetic.
Vec3 accurate_normal(const Vec3& a, const Vec3& b, const Vec3& c);

/// Order by x, then y, then z.
inline bool lexicographic_less(const Vec3& a, const Vec3& b) {
  if (a.x() != b.x()) return a.x() < b.x();
  if (a.y() != b.y()) return a.y() < b.y();
  return a.z() < b.z();
}

}  // namespace osteon::hull
