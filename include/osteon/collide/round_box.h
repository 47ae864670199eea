#pragma once

#include "osteon/base/types.h"
#include "osteon/collide/capsule_contact.h"
#include "osteon/collide/primitive.h"
#include "osteon/collide/segments.h"

namespace osteon {

/// All points within a radius of a core: a point, a segment, or a box. So balls, rods and boxes
/// with round edges are one shape.
struct RoundBox {
  Capsule rod;               ///< a ball or a rod; of a box its middle, twice, and the radius
  bool is_box = false;       ///< the core is a box:
  Pose X;                    ///< its middle and axes
  Vec3 half = Vec3::Zero();  ///< half its sides, m, 0 or more: it may be a rectangle
};

/// A ball or rod as it is. The faces of a box stay where they are; its edges are rounded by its
/// thinnest half side, by half a millimetre at most.
RoundBox round_box(const Primitive& part);
inline RoundBox round_box(const Capsule& rod) { return {rod, false, {}, Vec3::Zero()}; }

RoundBox placed(const Pose& X, const RoundBox& box);

/// A ball about the shape.
inline Vec3 middle_of(const RoundBox& box) { return 0.5 * (box.rod.p0 + box.rod.p1); }
double reach_of(const RoundBox& box);

/// Largest and smallest n.x over the shape, m; n is a unit vector in the frame of X.
double highest(const RoundBox& box, const Vec3& n);
double lowest(const RoundBox& box, const Vec3& n);

/// Where a core lies over a line, in the plane of the line and a direction across it.
struct OverLine {
  bool meets = false;  ///< the core has a point in that plane, over the line from its first end on
  double height = 0;   ///< of its lowest point over the line, m; negative: under it
  double share = 0;    ///< of the line, 0 to 1: over which place, with all that is nearly as low
};
/// Of a box. `n`: unit, across the line from a to b, which have some way between them. The height
/// is continuous in the box's pose as long as it meets the plane; so is the share, which lies
/// between the ends of a face that lies along the line.
OverLine lowest_over(const RoundBox& box, const Vec3& a, const Vec3& b, const Vec3& n);

/// Nearest points of two cores. Where more than one pair is as near, any of them: what lies between
/// them is the same. Cores that meet: two points at one place.
AxisPoints nearest_on_cores(const RoundBox& a, const RoundBox& b);

}  // namespace osteon
