#pragma once

#include <cstdint>

#include "osteon/base/types.h"
#include "osteon/collide/capsule_contact.h"
#include "osteon/collide/convex_body.h"

namespace osteon {

/// One part of an instrument as it is felt, in Tool: a ball or rod (all points within a radius of a
/// point or segment), or a box with sharp edges. Make it with make_rod or make_box.
struct Primitive {
  enum class Kind : std::uint8_t { kRod, kBox };
  Kind kind = Kind::kRod;
  Capsule rod;                 ///< of a rod; of a box its middle, twice, and no radius
  Pose X_TB;                   ///< of a box: its middle and axes
  Vec3 half = Vec3::Zero();    ///< of a box: half its sides, m
  ConvexBody body;             ///< of a box: its corners and planes, in Tool
  Vec3 middle = Vec3::Zero();  ///< of the ball about it, in Tool
  double radius = 0;           ///< of the ball about it, m
};

/// Equal ends: a ball. Finite, radius above 0.
Primitive make_rod(const Vec3& p0_T, const Vec3& p1_T, double radius_m);
/// Finite, all sides above 0.
Primitive make_box(const Pose& X_TB, const Vec3& half_m);

/// Largest n_T.x over the primitive, m; n_T is a unit vector in Tool.
double support(const Primitive& primitive, const Vec3& n_T);

}  // namespace osteon
