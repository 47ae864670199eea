#pragma once

#include <Eigen/Core>
#include <array>
#include <span>

#include "gl/extent_boxes.h"
#include "gl/tile_mask.h"
#include "osteon/render/camera.h"
#include "osteon/render/renderer.h"

namespace osteon {

/// The eight corners of a box.
std::array<Vec3, 8> corners(const Aabb& box);

/// Rectangle of the whole picture, 0..1 from its lower left corner: one tile of a large image.
struct PictureWindow {
  double x = 0, y = 0, width = 1, height = 1;
  bool operator==(const PictureWindow&) const = default;
};

/// What every draw call of a frame shares.
struct Frame {
  Pose X_CW;
  Eigen::Matrix4f clip_from_view = Eigen::Matrix4f::Identity();
  Eigen::Vector3f key_dir_C = Eigen::Vector3f::UnitZ();
  PictureWindow window;
  /// Clip units that one output pixel measures.
  Eigen::Vector2f pixel_clip = Eigen::Vector2f::Zero();
  /// Part that is drawn, in clip space over w: left, bottom, right, top.
  Eigen::Vector4d drawn{-1, -1, 1, 1};
  const TileMask* tiles = nullptr;  ///< tiles of the picture that are drawn; null: all
  bool passing = false;             ///< one of many pictures in which all moves
};

/// Projection onto the window, with the depth range just around `content`.
Eigen::Matrix4d projection(const Camera& camera, double aspect, const Aabb& content,
                           const PictureWindow& window);

/// `width`, `height`: output pixels of the window.
Frame make_frame(const ViewState& view, double aspect, const Aabb& content,
                 const PictureWindow& window, int width, int height);

/// Length in World that an output pixel covers where the ball is nearest to the eye.
double finest_metres_per_pixel(const Frame& frame, const Vec3& center_W, double radius_m);
/// The same of what lies in the boxes; those behind the eye do not count. The finest there may be
/// where none counts.
double finest_metres_per_pixel(const Frame& frame, const Pose& X_WB,
                               std::span<const ExtentBox> boxes_B);

/// False when no part of the ball can appear in the part that is drawn.
bool in_sight(const Frame& frame, const Vec3& center_W, double radius_m);

/// False when no part of the ball, in view space, can show in the tiles that are drawn.
bool in_tiles(const Frame& frame, const Vec3& center_C, double radius_m);

/// View-from-model matrix of a pose.
Eigen::Matrix4f to_matrix(const Pose& X);
/// The same for a model that is scaled: `across` in x and y, `along` in z.
Eigen::Matrix4f scaled(const Pose& X, double across, double along);

}  // namespace osteon
