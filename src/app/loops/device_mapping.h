#pragma once

#include "osteon/base/types.h"

namespace osteon {

/// Places the device's frame V in World. `scale` stretches positions (2: 1 cm at the hand is 2 cm
/// in the case); directions and forces only turn.
struct DeviceMapping {
  Pose X_WV;
  double scale = 1;

  Pose to_world(const Pose& X_VD) const {
    return {X_WV.q * (scale * X_VD.p) + X_WV.p, X_WV.q * X_VD.q};
  }
  Pose to_device(const Pose& X_WD) const {
    const Quat q_VW = X_WV.q.conjugate();
    return {(q_VW * (X_WD.p - X_WV.p)) / scale, q_VW * X_WD.q};
  }
  Vec3 force_to_device(const Vec3& force_W) const { return X_WV.q.conjugate() * force_W; }
};

}  // namespace osteon
