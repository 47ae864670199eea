#pragma once

#include <optional>

#include "osteon/base/types.h"

namespace osteon {

/// Camera that looks at a point of World. Camera frame: x right, y up, z towards the viewer.
struct Camera {
  Vec3 target_W = Vec3::Zero();
  double distance_m = 0.25;      ///< from the eye to the target
  Quat q_WC = Quat::Identity();  ///< turns Camera coordinates into World
  double vertical_fov_rad = 0.5;
  /// Parallel projection; things at the target's depth keep the size that they have in perspective.
  bool orthographic = false;
  /// The eye stands so far to the right of the line through the target, and still looks straight
  /// ahead: the picture is that of a window at the target's depth, where nothing shifts (an
  /// off-axis frustum). Parallel projection knows no eye.
  double eye_right_m = 0;

  Vec3 eye_W() const;
  Pose X_WC() const;
  /// Half of the height that the picture covers at the target's depth, metres.
  double half_height_m() const;
  bool operator==(const Camera&) const = default;
};

/// Part of a framebuffer, in its pixels; x, y count from its lower left corner, as OpenGL does.
struct Viewport {
  int x = 0, y = 0, width = 1280, height = 720;
  bool empty() const { return width <= 0 || height <= 0; }
  double aspect() const { return empty() ? 1.0 : static_cast<double>(width) / height; }
};

/// Half line; `dir_W` is a unit vector.
struct Ray {
  Vec3 origin_W = Vec3::Zero();
  Vec3 dir_W = -Vec3::UnitZ();
};

/// Pixel position (origin at the viewport's top left corner) and distance along the view direction.
struct PixelPoint {
  double x = 0, y = 0, depth_m = 0;
};

/// Rotation q_WC of a camera that sees the target from the side `view_from_W`, with
/// `up_W` upwards on the screen. The two need not be unit or at right angles, only not parallel.
Quat look_rotation(const Vec3& view_from_W, const Vec3& up_W);

/// Turntable: the picture follows a drag by (yaw, pitch) radians, rightwards and upwards positive.
/// Yaw turns about `axis_W` (unit, through the target), pitch about the camera's own x; the view
/// stops 1 degree short of looking along the axis, so it never turns over.
Camera orbit(const Camera& camera, const Vec3& axis_W, double yaw_rad, double pitch_rad);

/// Moves sideways so that what lies at the target's depth follows a drag by (right, up), given in
/// heights of the viewport.
Camera pan(const Camera& camera, double right_heights, double up_heights);

/// Multiplies the distance by `factor` (below 1 goes nearer), within 5 mm and 20 m.
Camera zoom(const Camera& camera, double factor);

/// Half line through a pixel (origin top left, pixel centres at .5): from the eye, or from 20 m
/// behind it when orthographic, since such a picture also shows what lies behind the eye.
Ray ray_through(const Camera& camera, const Viewport& viewport, double x_px, double y_px);

/// Where a point of World appears; nothing when it is not finite, or behind the eye of a
/// perspective camera.
std::optional<PixelPoint> project(const Camera& camera, const Viewport& viewport, const Vec3& p_W);

/// Length in World that one pixel covers at the depth of `p_W` (at the target's when behind).
double metres_per_pixel(const Camera& camera, const Viewport& viewport, const Vec3& p_W);

}  // namespace osteon
