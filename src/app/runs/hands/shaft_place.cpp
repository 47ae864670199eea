#include "runs/hands/shaft_place.h"

#include <cmath>

#include "osteon/base/turn.h"

namespace osteon {

Vec3 shaft_beside_tip(const Tool& tool) { return {tool.shaft.p0.x(), tool.shaft.p0.y(), 0}; }

Pose before_portal(const Tool& tool, const Vec3& p_W, const Vec3& inwards_W, double before_m) {
  const Quat q = turn_between(Vec3::UnitZ(), -inwards_W).normalized();
  return {p_W - before_m * inwards_W - q * shaft_beside_tip(tool), q};
}

Pose on_the_same_line(const Tool& before, const Tool& now, const Pose& X_WT) {
  return {X_WT * Vec3(shaft_beside_tip(before) - shaft_beside_tip(now)), X_WT.q};
}

// Symbols: b, from the tip across to the axis; back, from the tip to the hole. On the axis the hole
// lies at b + s z, where its distance from the tip is that of the hole.
Pose slid_through(Pose X_WT, const Vec3& beside_T, const Vec3& hole_W, double wheel) {
  constexpr double kWheel_m = 0.002, kInside_m = 0.003;
  X_WT.p -= wheel * kWheel_m * (X_WT.q * Vec3::UnitZ());
  const Vec3 back_W = hole_W - X_WT.p;
  const double square = back_W.squaredNorm() - beside_T.squaredNorm();
  if (back_W.dot(X_WT.q * Vec3::UnitZ()) < kInside_m || !(square > kInside_m * kInside_m))
    return X_WT;
  const Vec3 on_axis_T = beside_T + std::sqrt(square) * Vec3::UnitZ();
  X_WT.q = (turn_between(X_WT.q * on_axis_T, back_W) * X_WT.q).normalized();
  return X_WT;
}

}  // namespace osteon
