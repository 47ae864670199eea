#include "runs/hands/probe_drag.h"

#include <algorithm>
#include <cmath>

#include "osteon/base/turn.h"

namespace osteon {
namespace {

Quat turn_about(const Vec3& axis, double angle_rad) {
  return Quat(Eigen::AngleAxisd(angle_rad, axis));
}

Vec3 kept_within(const Vec3& p_W, const Vec3& center_W, double radius_m) {
  const Vec3 away = p_W - center_W;
  const double distance = away.norm();
  return distance <= radius_m ? p_W : Vec3(center_W + away * (radius_m / distance));
}

}  // namespace

Pose drag_probe(const Pose& X_WD, const ProbeMotion& motion, const Camera& camera,
                const Viewport& viewport, double dt_s, const ProbeDragParams& params) {
  const double m_per_px = metres_per_pixel(camera, viewport, X_WD.p);
  const Vec3 step_C(motion.right_px * m_per_px, motion.up_px * m_per_px,
                    -motion.wheel * params.wheel_m);
  const Vec3 on_W = motion.along * params.wheel_m * (X_WD.q * -Vec3::UnitZ());
  Pose moved;
  moved.p =
      kept_within(X_WD.p + camera.q_WC * step_C + on_W, camera.target_W, params.max_from_target_m);

  const double angle = params.turn_rad_per_s * dt_s;
  const Quat q_C = turn_about(Vec3::UnitY(), motion.yaw * angle) *
                   turn_about(Vec3::UnitX(), motion.pitch * angle) *
                   turn_about(Vec3::UnitZ(), motion.roll * angle);
  const Quat q_CW = camera.q_WC.conjugate();
  const Quat twist_D = turn_about(Vec3::UnitZ(), motion.twist * angle);
  moved.q = (camera.q_WC * q_C * q_CW * X_WD.q * twist_D).normalized();
  return moved;
}

Pose upright_on(const Pose& X_WD, const Vec3& p_W, bool inside) {
  constexpr double kTold_m = 1e-5;
  const Vec3 out_W = inside ? p_W - X_WD.p : X_WD.p - p_W;
  if (!(out_W.norm() > kTold_m)) return X_WD;
  return {X_WD.p, (turn_between(X_WD.q * Vec3::UnitZ(), out_W) * X_WD.q).normalized()};
}

Pose offered_probe(const Camera& camera, const Aabb& case_bounds_W) {
  constexpr double kClearance_m = 0.010;
  constexpr double kTilt_rad = 0.75;
  const Vec3 towards_viewer_W = camera.q_WC * Vec3::UnitZ();
  // The box's corner that is nearest to the viewer, measured along the view.
  const Vec3 half = 0.5 * case_bounds_W.extent();
  const double reach = half.cwiseAbs().dot(towards_viewer_W.cwiseAbs());
  const Vec3 center_W = case_bounds_W.empty() ? camera.target_W : case_bounds_W.center();
  Pose offered;
  offered.p = center_W + towards_viewer_W * ((case_bounds_W.empty() ? 0.0 : reach) + kClearance_m);
  // The shaft (Tool z) points to the viewer, then leans to the upper right.
  offered.q = (camera.q_WC * turn_about(Vec3(-1, 1, 0).normalized(), kTilt_rad)).normalized();
  return offered;
}

Pose probe_in_picture(const Camera& camera, const Aabb& case_bounds_W) {
  const Vec3 towards_viewer_W = camera.q_WC * Vec3::UnitZ();
  Pose offered = offered_probe(camera, case_bounds_W);
  const double in_front = (offered.p - camera.target_W).dot(towards_viewer_W);
  offered.p =
      camera.target_W + std::clamp(in_front, 0.0, 0.5 * camera.distance_m) * towards_viewer_W;
  return offered;
}

bool shows(const Camera& camera, double aspect, const Vec3& p_W) {
  const Vec3 p_C = camera.q_WC.conjugate() * (p_W - camera.target_W);
  const double depth = camera.distance_m - p_C.z();
  const double scale = camera.orthographic ? 1.0 : depth / camera.distance_m;
  const double half = camera.half_height_m() * scale;
  return depth > 0 && std::abs(p_C.y()) <= half && std::abs(p_C.x()) <= aspect * half;
}

}  // namespace osteon
