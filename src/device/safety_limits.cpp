#include "osteon/device/safety_limits.h"

#include <algorithm>

namespace osteon {

Vec3 clamped_norm(const Vec3& v, double limit) {
  const double n = v.norm();
  return n > limit ? Vec3(v * (limit / n)) : v;
}

Vec3 SlewLimit::next(const Vec3& wanted, double dt_s) {
  last_ += clamped_norm(wanted - last_, max_n_per_s_ * dt_s);
  return last_;
}

ForceBudget::ForceBudget(double peak_n, double continuous_n, double thermal_s)
    : peak_n_(peak_n),
      continuous_n_(continuous_n > 0 && continuous_n < peak_n ? continuous_n : 0),
      thermal_s_(thermal_s) {}

double ForceBudget::heat() const {
  return continuous_n_ > 0 ? mean_square_n2_ / (continuous_n_ * continuous_n_) : 0;
}

double ForceBudget::limit_n() const {
  if (continuous_n_ <= 0) return peak_n_;
  const double hot = std::clamp((heat() - 0.8) / 0.2, 0.0, 1.0);
  return peak_n_ + hot * (continuous_n_ - peak_n_);
}

void ForceBudget::spend(const Vec3& force, double dt_s) {
  if (dt_s <= 0) return;
  const double share = dt_s / (thermal_s_ + dt_s);
  mean_square_n2_ += share * (force.squaredNorm() - mean_square_n2_);
}

}  // namespace osteon
