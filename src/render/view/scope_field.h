#pragma once

#include "osteon/base/types.h"

namespace osteon {

/// The projection of a square picture as a pinhole sees it, `half` the tangent of half its width.
Eigen::Matrix4f pinhole(double half, double near_m, double far_m);

/// What a scope's flat picture can show, in view space: its square, or the round field in it.
class ScopeField {
 public:
  /// `half` is the tangent of half the square's width. The field is round to the share `round` of
  /// it; where that is beyond the corners, all of the square is seen.
  ScopeField(double half, double round);
  /// False when no part of the ball can show. What is nearer to the eye than `near_m` cannot.
  bool shows(const Vec3& center_C, double radius_m, double near_m) const;

 private:
  double half_, reach_;  ///< of the square: reach_ of a ball's radius beyond a side
  double cos_round_ = 0, sin_round_ = 1;  ///< of half the angle of the round field
  bool is_round_;
};

}  // namespace osteon
