#pragma once

#include "near_search.h"
#include "osteon/collide/lp_contact.h"
#include "simplex.h"

namespace osteon {

/// Rows of the contact programme of a pair, measured from A's centre in A's frame. B's planes are
/// turned when asked for; searches carry the point into B's frame instead. `near`, which may be
/// null, is where the searches look first.
class PairRows {
 public:
  PairRows(const ConvexBody& a, const ConvexBody& b, const Pose& X_AB, LpNear* near = nullptr)
      : a_(a),
        b_(b),
        near_(near),
        R_AB_(X_AB.q.toRotationMatrix()),
        p_centers_(X_AB.p + R_AB_ * b.center - a.center),
        scale_(2 * (a.radius + b.radius)) {}

  std::uint32_t count() const { return a_.plane_count + b_.plane_count; }
  double scale() const { return scale_; }
  bool is_a(std::uint32_t id) const { return id < a_.plane_count; }

  Row row(std::uint32_t id) const {
    if (is_a(id)) return {a_.normal(id), a_.offset[id]};
    const std::uint32_t k = id - a_.plane_count;
    const Vec3 n = R_AB_ * b_.normal(k);
    return {n, b_.offset[k] + n.dot(p_centers_)};
  }

  template <std::size_t N>
  Excess most_exceeded(const Vec3& x, double floor, const std::array<std::uint32_t, N>&) const {
    const Excess of_a = near_ ? osteon::most_exceeded(a_, x, floor, near_->planes_a)
                              : osteon::most_exceeded(a_, x, floor);
    const Excess of_b = near_ ? osteon::most_exceeded(b_, in_b(x), of_a.value, near_->planes_b)
                              : osteon::most_exceeded(b_, in_b(x), of_a.value);
    return of_b.plane == Excess::kNone ? of_a : from_b(of_b);
  }
  Excess likely_exceeded(const Vec3& x, double floor) const {
    const Excess of_a = osteon::likely_exceeded(a_, x, floor);
    const Excess of_b = osteon::likely_exceeded(b_, in_b(x), of_a.value);
    return of_b.plane == Excess::kNone ? of_a : from_b(of_b);
  }
  Excess first_exceeded(const Vec3& x, double floor) const {
    const Excess of_a = osteon::first_exceeded(a_, x, floor);
    if (of_a.plane != Excess::kNone) return of_a;
    return from_b(osteon::first_exceeded(b_, in_b(x), floor));
  }

  /// Lists the rows near `x`, which none exceeds by more than `level`.
  void list_near(const Vec3& x, double level) const {
    list_planes(a_, x, level, near_->planes_a);
    list_planes(b_, in_b(x), level, near_->planes_b);
  }

  const Mat3& R_AB() const { return R_AB_; }

 private:
  Vec3 in_b(const Vec3& x) const { return R_AB_.transpose() * (x - p_centers_); }
  Excess from_b(Excess e) const {
    if (e.plane != Excess::kNone) e.plane += a_.plane_count;
    return e;
  }

  const ConvexBody& a_;
  const ConvexBody& b_;
  LpNear* near_;
  Mat3 R_AB_;
  Vec3 p_centers_;  // from A's centre to B's
  double scale_;
};

}  // namespace osteon
