#pragma once

#include "loops/mapping_settings.h"
#include "osteon/base/types.h"

namespace osteon {

/// Makes up for the device's own friction and inertia, both off by default: a force along the
/// motion and along the acceleration. Too much of either would make the device run away, so both
/// are bounded by kMaxFriction_n and kMaxInertia_kg, and the whole by kMost_n.
class Assist {
 public:
  explicit Assist(const MappingSettings& settings)
      : friction_n_(settings.friction_n), inertia_kg_(settings.inertia_kg) {}
  /// N, in V.
  Vec3 force(const Vec3& v_V, double dt_s);

  static constexpr double kMost_n = 2;

 private:
  double friction_n_, inertia_kg_;
  Vec3 v_V_ = Vec3::Zero();  ///< smoothed
  Vec3 a_V_ = Vec3::Zero();  ///< smoothed
  bool started_ = false;
};

}  // namespace osteon
