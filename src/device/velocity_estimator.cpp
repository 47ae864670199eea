#include "velocity_estimator.h"

#include <algorithm>
#include <cmath>

namespace osteon {
namespace {

double seconds(std::int64_t ns) { return static_cast<double>(ns) * 1e-9; }

}  // namespace

Vec3 VelocityEstimator::add(std::int64_t time_ns, const Vec3& position) {
  if (count_ > 0 && time_ns <= back(0).time_ns) return velocity_;
  newest_ = (newest_ + 1) % kWindow;
  readings_[newest_] = {time_ns, position};
  count_ = std::min(count_ + 1, kWindow);
  velocity_.setZero();
  if (count_ > 1) velocity_ = Vec3(slope(0), slope(1), slope(2));
  return velocity_;
}

double VelocityEstimator::slope(int axis) const {
  double best = 0;
  for (std::size_t n = 1; n < count_; ++n) {
    const double way = back(0).position[axis] - back(n).position[axis];
    const double s = way / seconds(back(0).time_ns - back(n).time_ns);
    if (n > 1 && !fits(axis, n, s)) break;
    best = s;
  }
  return best;
}

bool VelocityEstimator::fits(int axis, std::size_t n, double slope) const {
  for (std::size_t i = 1; i < n; ++i) {
    const double line = back(0).position[axis] - slope * seconds(back(0).time_ns - back(i).time_ns);
    if (std::abs(back(i).position[axis] - line) > noise_) return false;
  }
  return true;
}

}  // namespace osteon
