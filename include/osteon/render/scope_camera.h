#pragma once

#include <optional>

#include "osteon/base/types.h"
#include "osteon/render/camera.h"
#include "osteon/scene/scope.h"

namespace osteon {

/// How an arthroscope is held. Its shaft runs from the tip `at_W` backwards; the camera head is
/// turned about the shaft by itself, and so is the scope in it, whose light post shows which way
/// the oblique view is tipped.
struct ScopePose {
  Vec3 at_W = Vec3::Zero();        ///< the tip's window
  Vec3 toward_W = -Vec3::UnitZ();  ///< a point that the shaft points to
  Vec3 up_W = Vec3::UnitY();       ///< upwards in the picture, as the camera head is held
  double post_rad = 0;  ///< 0: tipped upwards in the picture; then clockwise as the surgeon sees it
};

/// A scope's camera in water: frame C has x right, y up, z towards the viewer; the picture is
/// round.
class ScopeCamera {
 public:
  /// Where `toward_W` or `up_W` give no direction, a fixed one stands for them.
  ScopeCamera(const ScopeDef& scope, const ScopePose& pose);

  const Pose& X_WC() const { return X_WC_; }
  /// Half of the field, from the middle to the field stop.
  double half_field_rad() const { return half_field_; }
  /// Share of the picture's radius at which something so far off the middle is seen, and back.
  double radius_share(double off_middle_rad) const;
  double off_middle_rad(double radius_share) const;
  /// Angle in the picture, from its right counter-clockwise, to which the view is tipped.
  double tipped_to_rad() const { return tipped_to_; }
  double barrel() const { return barrel_; }

  /// Radius of the round picture in the viewport, pixels.
  static double radius_px(const Viewport& viewport);
  /// Where a point of World appears (pixel centres at .5, from the top left); nothing when it lies
  /// outside of the field. The depth is its distance along the view.
  std::optional<PixelPoint> project(const Viewport& viewport, const Vec3& p_W) const;
  /// Half line through a pixel; nothing outside of the field stop.
  std::optional<Ray> ray_through(const Viewport& viewport, double x_px, double y_px) const;

 private:
  Pose X_WC_;
  double half_field_, barrel_, tipped_to_;
};

}  // namespace osteon
