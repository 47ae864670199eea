#pragma once

#include <vector>

#include "osteon/base/types.h"

namespace osteon {

/// Poses at equal steps of a parameter, joined by a smooth curve.
struct PoseTrack {
  double first = 0;  ///< the parameter at poses[0]
  double step = 1;   ///< above 0, in the parameter's unit
  std::vector<Pose> poses;

  double last() const { return first + step * (static_cast<double>(poses.size()) - 1); }
};

/// The pose at `x`, kept within the track. It goes through every given pose; place and turn change
/// without a jump in their rates (uniform Catmull-Rom over places and over the quaternions'
/// components, the latter brought back to length 1; for turns of less than a right angle a step).
/// The track must hold a pose.
Pose pose_at(const PoseTrack& track, double x);

}  // namespace osteon
