#pragma once

#include "osteon/collide/capsule_contact.h"

namespace osteon {

/// Nearest points of two capsules' axes.
struct AxisPoints {
  Vec3 a = Vec3::Zero(), b = Vec3::Zero();
};

/// Closed form: the nearest points of two segments (Ericson, Real-Time Collision Detection, 2005,
/// section 5.1.9). Parallel ones: any of their nearest points.
AxisPoints nearest_on_axes(const Capsule& a, const Capsule& b);

}  // namespace osteon
