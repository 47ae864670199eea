#include "osteon/render/scope_camera.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace osteon {
namespace {

/// Share of the picture's shorter side that the round picture fills.
constexpr double kFilled = 0.96;

Vec3 direction_or(const Vec3& v, const Vec3& other) {
  const double length = v.norm();
  return length > 1e-12 && std::isfinite(length) ? Vec3(v / length) : other;
}

/// Turns a head at right angles to the shaft whose picture has `up` upwards as far as it can.
Mat3 head_axes(const Vec3& shaft, const Vec3& up) {
  Vec3 y = up - up.dot(shaft) * shaft;
  if (y.norm() < 1e-6) y = shaft.unitOrthogonal();
  y.normalize();
  Mat3 axes;
  axes << y.cross(-shaft), y, -shaft;
  return axes;
}

}  // namespace

/// Frames: the head's (x right, y up, z back along the shaft) turns with the camera head. The prism
/// tips the view from -z by the scope's angle about an axis across the shaft, which the post turns;
/// it turns the picture about no other axis, so what is up for the head stays up.
ScopeCamera::ScopeCamera(const ScopeDef& scope, const ScopePose& pose)
    : half_field_(0.5 * field_in_water_rad(scope)), barrel_(scope.barrel) {
  const Vec3 shaft = direction_or(pose.toward_W - pose.at_W, -Vec3::UnitZ());
  const Mat3 R_WH = head_axes(shaft, direction_or(pose.up_W, Vec3::UnitY()));
  tipped_to_ = 0.5 * std::numbers::pi - pose.post_rad;
  const Vec3 tipped_to_H(std::cos(tipped_to_), std::sin(tipped_to_), 0);
  const Vec3 axis_H = tipped_to_H.cross(Vec3::UnitZ());
  const Mat3 R_HC = Eigen::AngleAxisd(scope.angle_rad, axis_H).toRotationMatrix();
  X_WC_ = {pose.at_W, Quat(Mat3(R_WH * R_HC))};
}

double ScopeCamera::radius_share(double off_middle_rad) const {
  return std::tan(barrel_ * off_middle_rad) / std::tan(barrel_ * half_field_);
}

double ScopeCamera::off_middle_rad(double radius_share) const {
  return std::atan(radius_share * std::tan(barrel_ * half_field_)) / barrel_;
}

double ScopeCamera::radius_px(const Viewport& viewport) {
  return 0.5 * kFilled * std::min(viewport.width, viewport.height);
}

std::optional<PixelPoint> ScopeCamera::project(const Viewport& viewport, const Vec3& p_W) const {
  const Vec3 p_C = X_WC_.inverse() * p_W;
  if (!is_finite(p_C)) return std::nullopt;
  const double aside = std::hypot(p_C.x(), p_C.y());
  const double off_middle = std::atan2(aside, -p_C.z());
  if (off_middle > half_field_ || (aside == 0 && p_C.z() >= 0)) return std::nullopt;
  const double r = aside > 0 ? radius_px(viewport) * radius_share(off_middle) / aside : 0;
  return PixelPoint{0.5 * viewport.width + r * p_C.x(), 0.5 * viewport.height - r * p_C.y(),
                    -p_C.z()};
}

std::optional<Ray> ScopeCamera::ray_through(const Viewport& viewport, double x_px,
                                            double y_px) const {
  const double x = x_px - 0.5 * viewport.width, y = 0.5 * viewport.height - y_px;
  const double aside = std::hypot(x, y), share = aside / radius_px(viewport);
  if (!(share <= 1)) return std::nullopt;
  const double a = off_middle_rad(share), across = aside > 0 ? std::sin(a) / aside : 0;
  return Ray{X_WC_.p, X_WC_.rotate(Vec3(x * across, y * across, -std::cos(a)))};
}

}  // namespace osteon
