#pragma once

#include <array>

#include "osteon/base/types.h"

namespace osteon {

/// `v`, shortened to `limit` where it is longer; its direction stays.
Vec3 clamped_norm(const Vec3& v, double limit);

/// Bounds how fast a force may change, as a vector.
class SlewLimit {
 public:
  explicit SlewLimit(double max_n_per_s) : max_n_per_s_(max_n_per_s) {}
  /// The force nearest to `wanted` that may follow the last one after `dt_s`.
  Vec3 next(const Vec3& wanted, double dt_s);
  /// What became of the last force in a later stage: the next change counts from there.
  void settle(const Vec3& force) { last_ = force; }

 private:
  double max_n_per_s_;
  Vec3 last_ = Vec3::Zero();
};

/// Peak and continuous force of motors. Their heat follows the square of the force with one time
/// constant; from 80 % of the bearable heat on, the limit goes from the peak to the continuous
/// force in a line (a switch would chatter).
class ForceBudget {
 public:
  /// `continuous_n` not between 0 and `peak_n`: the motors bear the peak for ever.
  ForceBudget(double peak_n, double continuous_n, double thermal_s);
  double limit_n() const;
  Vec3 limited(const Vec3& force) const { return clamped_norm(force, limit_n()); }
  /// The motors gave `force` for `dt_s`.
  void spend(const Vec3& force, double dt_s);
  /// Mean square force as a share of what the motors bear for ever; 0 when they bear all.
  double heat() const;

 private:
  double peak_n_, continuous_n_, thermal_s_;
  double mean_square_n2_ = 0;
};

}  // namespace osteon
