#include "osteon/render/camera.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace osteon {
namespace {

constexpr double kLargestElevation = 89.0 * std::numbers::pi / 180.0;
constexpr double kNearest_m = 0.005;
constexpr double kFarthest_m = 20.0;

/// Angle of the direction to the viewer above the plane that `axis_W` is normal to.
double elevation(const Quat& q_WC, const Vec3& axis_W) {
  return std::asin(std::clamp((q_WC * Vec3::UnitZ()).dot(axis_W), -1.0, 1.0));
}

Quat turned(const Vec3& axis_W, double angle_rad, const Quat& q) {
  return (Quat(Eigen::AngleAxisd(angle_rad, axis_W)) * q).normalized();
}

}  // namespace

Vec3 Camera::eye_W() const { return target_W + q_WC * Vec3(eye_right_m, 0, distance_m); }

Pose Camera::X_WC() const { return {eye_W(), q_WC}; }

double Camera::half_height_m() const { return distance_m * std::tan(0.5 * vertical_fov_rad); }

Quat look_rotation(const Vec3& view_from_W, const Vec3& up_W) {
  const Vec3 z = view_from_W.normalized();
  const Vec3 x = up_W.cross(z).normalized();
  Mat3 R_WC;
  R_WC << x, z.cross(x), z;
  return Quat(R_WC).normalized();
}

Camera orbit(const Camera& camera, const Vec3& axis_W, double yaw_rad, double pitch_rad) {
  // Upside down, a drag to the right must still move what is near to the right.
  const double upright = (camera.q_WC * Vec3::UnitY()).dot(axis_W) < 0 ? -1.0 : 1.0;
  Camera out = camera;
  out.q_WC = turned(axis_W, -upright * yaw_rad, camera.q_WC);
  // A drag upwards moves what is near upwards: the eye goes down.
  const double before = elevation(out.q_WC, axis_W);
  const double wanted = before - upright * pitch_rad;
  const double lowest = std::min(before, -kLargestElevation);
  const double highest = std::max(before, kLargestElevation);
  const double allowed = std::clamp(wanted, lowest, highest) - before;
  const Quat pitched = turned(out.q_WC * Vec3::UnitX(), -upright * allowed, out.q_WC);
  // A rolled camera's own x is not level, so the step may still lead over the top: then leave it.
  const double after = std::abs(elevation(pitched, axis_W));
  if (after <= std::max(kLargestElevation + 1e-6, std::abs(before))) out.q_WC = pitched;
  return out;
}

Camera pan(const Camera& camera, double right_heights, double up_heights) {
  const double height_m = 2 * camera.half_height_m();
  Camera out = camera;
  out.target_W -= camera.q_WC * Vec3(right_heights * height_m, up_heights * height_m, 0);
  return out;
}

Camera zoom(const Camera& camera, double factor) {
  Camera out = camera;
  out.distance_m = std::clamp(camera.distance_m * factor, kNearest_m, kFarthest_m);
  return out;
}

Ray ray_through(const Camera& camera, const Viewport& viewport, double x_px, double y_px) {
  const double width = std::max(viewport.width, 1);
  const double height = std::max(viewport.height, 1);
  const double half = camera.half_height_m();
  // The pixel's point in the plane through the target, in Camera axes with the target as origin.
  const Vec3 pixel((2 * x_px - width) / height * half, (1 - 2 * y_px / height) * half, 0);
  if (camera.orthographic) {
    const Vec3 start = pixel + Vec3(0, 0, camera.distance_m + kFarthest_m);
    return {camera.target_W + camera.q_WC * start, camera.q_WC * -Vec3::UnitZ()};
  }
  const Vec3 eye(camera.eye_right_m, 0, camera.distance_m);
  return {camera.eye_W(), camera.q_WC * (pixel - eye).normalized()};
}

std::optional<PixelPoint> project(const Camera& camera, const Viewport& viewport, const Vec3& p_W) {
  const Vec3 p_C = camera.X_WC().inverse() * p_W;
  const double depth = -p_C.z();
  if (!is_finite(p_C) || (depth <= 0 && !camera.orthographic)) return std::nullopt;
  const double shrink = camera.orthographic ? 1.0 : camera.distance_m / depth;
  const double scale = 0.5 * viewport.height / camera.half_height_m();
  return PixelPoint{0.5 * viewport.width + scale * (shrink * p_C.x() + camera.eye_right_m),
                    0.5 * viewport.height - scale * shrink * p_C.y(), depth};
}

double metres_per_pixel(const Camera& camera, const Viewport& viewport, const Vec3& p_W) {
  const double at_target = 2 * camera.half_height_m() / std::max(viewport.height, 1);
  const double depth = -(camera.X_WC().inverse() * p_W).z();
  if (camera.orthographic || !(depth > 0)) return at_target;
  return at_target * depth / camera.distance_m;
}

}  // namespace osteon
