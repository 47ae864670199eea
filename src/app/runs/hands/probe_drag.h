#pragma once

#include "osteon/base/types.h"
#include "osteon/render/camera.h"

namespace osteon {

/// What the mouse and the keys did since the last frame, while they hold the probe.
struct ProbeMotion {
  double right_px = 0, up_px = 0;       ///< of the pointer
  double wheel = 0;                     ///< notches, positive pushes the probe away from the viewer
  double along = 0;                     ///< notches, positive pushes the tip on along the shaft
  double pitch = 0, yaw = 0, roll = 0;  ///< keys, each in [-1, 1]
  double twist = 0;                     ///< about the instrument's own shaft, as those
};

/// Speeds by which the mouse holds the probe.
struct ProbeDragParams {
  double wheel_m = 0.002;           ///< along the view or the shaft a notch
  double turn_rad_per_s = 1.2;      ///< while a key is down
  double max_from_target_m = 0.40;  ///< the probe stays within this of what the camera looks at
};

/// The hand's pose after `motion`: the tip follows the pointer in the plane of the view, at its own
/// depth, or goes along the shaft; turns are about the camera's axes through the tip, and a twist
/// about the shaft through the tip.
Pose drag_probe(const Pose& X_WD, const ProbeMotion& motion, const Camera& camera,
                const Viewport& viewport, double dt_s, const ProbeDragParams& params = {});

/// The same place with the shaft upright on a surface whose nearest point is `p_W`: the tip points
/// at it, or, where the tip has gone in, away from it. Turned no more about its shaft than that
/// takes. As it is where the tip lies on that point.
Pose upright_on(const Pose& X_WD, const Vec3& p_W, bool inside);

/// Where a probe is handed to the user: in front of the case as the camera sees it, tilted so that
/// the shaft does not hide its tip.
Pose offered_probe(const Camera& camera, const Aabb& case_bounds_W);

/// The same in the middle of the picture, in front of what the camera looks at: of a close-up,
/// whose case may reach beyond the eye, half-way to the eye at most.
Pose probe_in_picture(const Camera& camera, const Aabb& case_bounds_W);

/// Whether p_W shows in a picture of this width over its height.
bool shows(const Camera& camera, double aspect, const Vec3& p_W);

}  // namespace osteon
