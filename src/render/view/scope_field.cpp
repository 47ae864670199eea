#include "view/scope_field.h"

#include <cmath>
#include <numbers>

namespace osteon {

ScopeField::ScopeField(double half, double round)
    : half_(half), reach_(std::sqrt(1 + half * half)), is_round_(round < std::numbers::sqrt2) {
  if (!is_round_) return;
  const double widest_rad = std::atan(half * round);
  cos_round_ = std::cos(widest_rad);
  sin_round_ = std::sin(widest_rad);
}

bool ScopeField::shows(const Vec3& center_C, double radius_m, double near_m) const {
  const double depth_m = -center_C.z();
  if (!(depth_m + radius_m > near_m)) return false;
  if (is_round_) {
    const double off_m = std::hypot(center_C.x(), center_C.y());
    return off_m * cos_round_ - depth_m * sin_round_ <= radius_m;
  }
  const double edge_m = half_ * depth_m, reach_m = radius_m * reach_;
  return std::abs(center_C.x()) - edge_m <= reach_m && std::abs(center_C.y()) - edge_m <= reach_m;
}

Eigen::Matrix4f pinhole(double half, double near_m, double far_m) {
  Eigen::Matrix4d m = Eigen::Matrix4d::Zero();
  m(0, 0) = m(1, 1) = 1 / half;
  m(2, 2) = -(far_m + near_m) / (far_m - near_m);
  m(2, 3) = -2 * far_m * near_m / (far_m - near_m);
  m(3, 2) = -1;
  return m.cast<float>();
}

}  // namespace osteon
