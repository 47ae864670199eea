#pragma once

#include <array>
#include <span>
#include <vector>

#include "osteon/base/types.h"

namespace osteon {

/// How a flat curved part lies: which way is up from the bone that it lies on, and its outline seen
/// from there. The outline is convex: along a C it follows the outer edge, and passes from the tip
/// of one horn to that of the other.
class RimOutline {
 public:
  /// `below`: a point on the side of the bone.
  RimOutline(std::span<const Vec3> points, const Vec3& below);

  const Vec3& up() const { return up_; }
  /// Over the middle of the points.
  double height(const Vec3& p) const { return up_.dot(p - middle_); }
  /// How far inside the outline; negative outside.
  double inside(const Vec3& p) const;

 private:
  std::array<double, 2> flat(const Vec3& p) const;

  Vec3 middle_ = Vec3::Zero(), up_ = Vec3::UnitZ(), right_ = Vec3::UnitX(), ahead_ = Vec3::UnitY();
  std::vector<std::array<double, 2>> corners_;  ///< counter-clockwise
};

}  // namespace osteon
