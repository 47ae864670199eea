#include "gl/frame.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace osteon {
namespace {

/// Enlarges the window to the whole of clip space.
Eigen::Matrix4d crop(const PictureWindow& w) {
  Eigen::Matrix4d m = Eigen::Matrix4d::Identity();
  m(0, 0) = 1 / w.width;
  m(1, 1) = 1 / w.height;
  m(0, 3) = (1 - 2 * w.x - w.width) / w.width;
  m(1, 3) = (1 - 2 * w.y - w.height) / w.height;
  return m;
}

}  // namespace

std::array<Vec3, 8> corners(const Aabb& box) {
  std::array<Vec3, 8> out;
  for (std::size_t k = 0; k < 8; ++k)
    out[k] = Vec3((k & 1 ? box.hi : box.lo).x(), (k & 2 ? box.hi : box.lo).y(),
                  (k & 4 ? box.hi : box.lo).z());
  return out;
}

Eigen::Matrix4d projection(const Camera& camera, double aspect, const Aabb& content,
                           const PictureWindow& window) {
  const Pose X_CW = camera.X_WC().inverse();
  double near = 1e300, far = -1e300;
  for (const Vec3& p_W : corners(content.grown(1e-4))) {
    const double depth = -(X_CW * p_W).z();
    near = std::min(near, depth);
    far = std::max(far, depth);
  }
  Eigen::Matrix4d m = Eigen::Matrix4d::Zero();
  const double half = std::max(camera.half_height_m(), 1e-9);
  const double to_the_right = camera.eye_right_m / (half * aspect);
  if (camera.orthographic) {
    m(0, 3) = to_the_right;
    m(0, 0) = 1 / (half * aspect);
    m(1, 1) = 1 / half;
    m(2, 2) = -2 / (far - near);
    m(2, 3) = -(far + near) / (far - near);
    m(3, 3) = 1;
  } else {
    // Something near the eye may be cut, but 24 bits of depth must still tell 10 um apart.
    far = std::max(far, 2e-3);
    near = std::clamp(near, std::max(1e-3, far * 2e-3), far * 0.999);
    const double t = std::tan(0.5 * camera.vertical_fov_rad);
    m(0, 0) = 1 / (t * aspect);
    m(0, 2) = -to_the_right;
    m(1, 1) = 1 / t;
    m(2, 2) = -(far + near) / (far - near);
    m(2, 3) = -2 * far * near / (far - near);
    m(3, 2) = -1;
  }
  return crop(window) * m;
}

Frame make_frame(const ViewState& view, double aspect, const Aabb& content,
                 const PictureWindow& window, int width, int height) {
  Frame frame;
  frame.X_CW = view.camera.X_WC().inverse();
  frame.clip_from_view = projection(view.camera, aspect, content, window).cast<float>();
  const double azimuth = view.light_azimuth_rad, elevation = view.light_elevation_rad;
  frame.key_dir_C = Eigen::Vector3d(std::sin(azimuth) * std::cos(elevation), std::sin(elevation),
                                    std::cos(azimuth) * std::cos(elevation))
                        .cast<float>();
  frame.window = window;
  frame.pixel_clip =
      Eigen::Vector2f(2.0f / static_cast<float>(width), 2.0f / static_cast<float>(height));
  return frame;
}

bool in_sight(const Frame& frame, const Vec3& center_W, double radius_m) {
  // Clip space's planes are x - left w, right w - x and so on; as functions of the view position
  // their gradients are not unit (Gribb and Hartmann 2001).
  const Eigen::Matrix4d clip = frame.clip_from_view.cast<double>();
  const Eigen::Vector4d center_C = (frame.X_CW * center_W).homogeneous();
  for (const int axis : {0, 1}) {
    for (const double sign : {-1.0, 1.0}) {
      const double edge = frame.drawn[sign > 0 ? axis : axis + 2];
      const Eigen::RowVector4d plane = sign * (clip.row(axis) - edge * clip.row(3));
      if (plane.dot(center_C) < -radius_m * plane.head<3>().norm()) return false;
    }
  }
  return true;
}

double finest_metres_per_pixel(const Frame& frame, const Vec3& center_W, double radius_m) {
  constexpr double kNearest_m = 1e-3;
  const Eigen::Matrix4d clip = frame.clip_from_view.cast<double>();
  const bool perspective = clip(3, 2) != 0;
  const double depth = -(frame.X_CW * center_W).z() - radius_m;
  const double w = perspective ? std::max(depth, kNearest_m) : 1.0;
  return static_cast<double>(frame.pixel_clip.y()) * w / clip(1, 1);
}

double finest_metres_per_pixel(const Frame& frame, const Pose& X_WB,
                               std::span<const ExtentBox> boxes_B) {
  const Pose X_CB = frame.X_CW * X_WB;
  const Vec3 eye_axis_B = (X_CB.q.conjugate() * Vec3::UnitZ()).cwiseAbs();
  double nearest_m = std::numeric_limits<double>::infinity();
  for (const ExtentBox& box : boxes_B) {
    const double depth_m = -(X_CB * box.center).z(), reach_m = eye_axis_B.dot(box.half_m);
    if (depth_m + reach_m > 0) nearest_m = std::min(nearest_m, depth_m - reach_m);
  }
  if (!std::isfinite(nearest_m)) nearest_m = 0;
  return finest_metres_per_pixel(frame, frame.X_CW.inverse() * Vec3(0, 0, -nearest_m), 0);
}

bool in_tiles(const Frame& frame, const Vec3& center_C, double radius_m) {
  if (frame.tiles == nullptr) return true;
  // The edge smoothing looks some pixels over a tile's edge.
  constexpr double kSlack_px = 8;
  const Eigen::Matrix4d m = frame.clip_from_view.cast<double>();
  const Eigen::Vector4d clip = m * center_C.homogeneous();
  const double nearest_w = m(3, 2) != 0 ? clip.w() - radius_m : 1.0;
  if (nearest_w <= 0) return true;
  const Eigen::Vector2d pixel_clip = frame.pixel_clip.cast<double>();
  const Eigen::Vector2d at = ((clip.head<2>() / clip.w()).array() + 1) / pixel_clip.array();
  // A ball away from the middle of a perspective picture appears longer, by less than this.
  const double stretch = m(3, 2) != 0 ? clip.head<3>().norm() / clip.w() + 1 : 1.0;
  const double radius_px = stretch * radius_m * m(1, 1) / (nearest_w * pixel_clip.y());
  return frame.tiles->reaches(at, radius_px + kSlack_px);
}

Eigen::Matrix4f to_matrix(const Pose& X) {
  Eigen::Matrix4d m = Eigen::Matrix4d::Identity();
  m.topLeftCorner<3, 3>() = X.q.toRotationMatrix();
  m.topRightCorner<3, 1>() = X.p;
  return m.cast<float>();
}

Eigen::Matrix4f scaled(const Pose& X, double across, double along) {
  Eigen::Matrix4f m = to_matrix(X);
  m.col(0) *= static_cast<float>(across);
  m.col(1) *= static_cast<float>(across);
  m.col(2) *= static_cast<float>(along);
  return m;
}

}  // namespace osteon
