#pragma once

#include "osteon/base/types.h"

namespace osteon {

/// Which part of a triangle a point lies on.
enum class TrianglePart { kFace, kEdge0, kEdge1, kEdge2, kCorner0, kCorner1, kCorner2 };

struct TrianglePoint {
  Vec3 point = Vec3::Zero();
  TrianglePart part = TrianglePart::kFace;
};

/// Point of the triangle abc closest to p (Ericson, Real-Time Collision Detection, 2005, 5.1.5).
/// Edge k runs from corner k to the next. A triangle without area is its three sides.
TrianglePoint closest_on_triangle(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c);

}  // namespace osteon
