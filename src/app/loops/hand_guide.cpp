#include "loops/hand_guide.h"

#include <algorithm>
#include <cmath>

namespace osteon {
namespace {

Vec3 shortened(const Vec3& v, double most) {
  const double length = v.norm();
  return length > most ? Vec3(v * (most / length)) : v;
}

Vec3 pull_to(const GuideLine& line, const Vec3& tip_W) {
  if (!line.on) return Vec3::Zero();
  const Vec3 to_W = line.p_W - tip_W;
  const Vec3 across_W = to_W - to_W.dot(line.along_W) * line.along_W;
  return line.strength * shortened(HandGuide::kStiffness_n_per_m * across_W, HandGuide::kMost_n);
}

bool is_usable(const GuideLine& line) {
  return is_finite(line.p_W) && is_finite(line.along_W) && line.strength >= 0 && line.strength <= 1;
}

bool is_same(const GuideLine& a, const GuideLine& b) {
  return a.on == b.on && a.p_W == b.p_W && a.along_W == b.along_W && a.strength == b.strength;
}

}  // namespace

Vec3 HandGuide::force_W(const GuideLine& line, const Vec3& tip_W, double dt_s) {
  if (!is_finite(tip_W) || !is_usable(line)) {
    *this = {};
    return Vec3::Zero();
  }
  if (!is_same(line, line_)) {
    rest_W_ += pull_to(line_, tip_W) - pull_to(line, tip_W);
    line_ = line;
  }
  const double left = rest_W_.norm() - kMostChange_n_per_s * std::max(0.0, dt_s);
  rest_W_ = left > 0 ? shortened(rest_W_, left) : Vec3(Vec3::Zero());
  return shortened(pull_to(line_, tip_W) + rest_W_, kMost_n);
}

}  // namespace osteon
