#include "osteon/collide/field_contact.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "field_box.h"

namespace osteon {
namespace {

constexpr std::size_t kMostSamples = 64;
// In a hole that a rod fills every place of its axis is nearly the lowest. A wall bends by less
// than the proxy's skin between so many.
constexpr std::size_t kMostInHole = 20;
constexpr double kEnough = 1e-7;  // m: how well the lowest height is known

struct Place {
  double s = 0;  ///< along the axis, 0 to 1
  FieldSample field;
};

// Lowest point of the axis by lower bounds from the steepest slope (Piyavskii 1972). Symbols: s is
// the share of the axis, d(s) the field there. Invariant: between two neighbouring samples d is
// nowhere below their lower_bound. Ends: when no bound is lower than the best sample by kEnough, or
// after kMostSamples samples.
class LowestPoint {
 public:
  LowestPoint(const FieldView& field, const Capsule& c, double far_m)
      : field_(field),
        c_(c),
        length_((c.p1 - c.p0).norm()),
        far_(far_m + c.radius),
        most_(field.is_carved() ? kMostInHole : kMostSamples) {}

  Place find() {
    add(0);
    if (!(length_ > 0)) return looked_at(best_);
    add(1);
    while (count_ < most_) {
      std::size_t widest = 0;
      double lowest = best_.distance - kEnough;
      for (std::size_t i = 0; i + 1 < count_; ++i) {
        if (!(bounds_[i] < lowest)) continue;
        lowest = bounds_[i];
        widest = i + 1;
      }
      if (widest == 0) break;
      if (lowest > far_) return at_least(lowest);
      add(0.5 * (places_[widest - 1].s + places_[widest].s), widest);
    }
    return settled();
  }

 private:
  // Not set to nothing at first: so many would take as long as a few looks at the field.
  struct Height {
    double s, distance;
  };
  Vec3 at(double s) const { return c_.p0 + s * (c_.p1 - c_.p0); }

  // The search asks for distances alone, and for the slope of what it has found.
  Place looked_at(const Height& found) const {
    Place out;
    out.s = found.s;
    out.field.distance = found.distance;
    if (std::isfinite(found.distance)) out.field = field_.again(at(found.s));
    return out;
  }

  // All that is known is how far the whole axis is at least.
  Place at_least(double distance) const {
    Place out = looked_at(best_);
    out.field.distance = distance;
    return out;
  }

  double lower_bound(const Height& a, const Height& b) const {
    return 0.5 * (a.distance + b.distance - FieldView::kSteepest * (b.s - a.s) * length_);
  }

  void add(double s, std::size_t before = kMostSamples) {
    const Height place{s, field_.distance_at(at(s))};
    if (before > count_) before = count_;
    const auto at_place = static_cast<std::ptrdiff_t>(before);
    const auto end = static_cast<std::ptrdiff_t>(count_);
    std::copy_backward(places_.begin() + at_place, places_.begin() + end,
                       places_.begin() + end + 1);
    std::copy_backward(bounds_.begin() + at_place, bounds_.begin() + end,
                       bounds_.begin() + end + 1);
    places_[before] = place;
    ++count_;
    if (before > 0) bounds_[before - 1] = lower_bound(places_[before - 1], places_[before]);
    if (before + 1 < count_) bounds_[before] = lower_bound(places_[before], places_[before + 1]);
    if (place.distance < best_.distance) best_ = place;
  }

  // Halves the slope's sign change about the best sample: a flat minimum leaves its place, and so
  // the normal, badly known.
  Place settled() const {
    std::size_t i = 0;
    while (places_[i].s < best_.s) ++i;
    Place out = looked_at(best_);
    const double slope = slope_of(out);
    const bool rises = slope > 0;
    if (slope == 0 || (rises && i == 0) || (!rises && i + 1 == count_)) return out;
    double low = rises ? places_[i - 1].s : best_.s;
    double high = rises ? best_.s : places_[i + 1].s;
    const int halvings = field_.is_carved() ? 8 : 16;
    for (int n = 0; n < halvings; ++n) {
      const double s = 0.5 * (low + high);
      const Place middle{s, field_.at(at(s))};
      if (middle.field.distance <= out.field.distance) out = middle;
      (slope_of(middle) > 0 ? high : low) = s;
    }
    return out;
  }
  double slope_of(const Place& p) const { return p.field.gradient.dot(c_.p1 - c_.p0); }

  const FieldView& field_;
  const Capsule& c_;
  double length_;
  double far_;        // from the axis, m: what is farther may be told as a bound
  std::size_t most_;  // samples
  std::array<Height, kMostSamples> places_;
  std::array<double, kMostSamples> bounds_;  // of each place and the next one
  std::size_t count_ = 0;
  Height best_{0, std::numeric_limits<double>::infinity()};
};

bool is_usable(const Capsule& c) {
  return is_finite(c.p0) && is_finite(c.p1) && std::isfinite(c.radius) && c.radius >= 0;
}

// The part of the axis within `reach` of the field's box along each axis of its frame; false when
// there is none (the slabs of Kay and Kajiya, 1986).
bool clip_to_box(const FieldView& field, double reach, Capsule& c) {
  const Vec3 along = c.p1 - c.p0;
  double from = 0, to = 1;
  for (Eigen::Index k = 0; k < 3; ++k) {
    const double lo = field.box().lo[k] - reach - c.p0[k];
    const double hi = field.box().hi[k] + reach - c.p0[k];
    if (along[k] == 0) {
      if (lo > 0 || hi < 0) return false;
      continue;
    }
    const double a = lo / along[k], b = hi / along[k];
    from = std::max(from, std::min(a, b));
    to = std::min(to, std::max(a, b));
  }
  if (from > to) return false;
  const Vec3 p0 = c.p0;
  if (from > 0) c.p0 = p0 + from * along;
  if (to < 1) c.p1 = p0 + to * along;
  return true;
}

// No nearer than `far_m`, seen from the middle of the bone.
CapsuleContact beyond(const FieldView& field, const Capsule& c, double far_m) {
  CapsuleContact out;
  out.status = LpStatus::kOptimal;
  out.gap = far_m;
  out.p_axis_A = 0.5 * (c.p0 + c.p1);
  const Vec3 away = out.p_axis_A - field.box().center();
  if (away.squaredNorm() > 0) out.nhat_AB_A = away.normalized();
  out.p_A = out.p_axis_A - (far_m + c.radius) * out.nhat_AB_A;
  return out;
}

}  // namespace

CapsuleContact field_contact(const FieldView& field, const Capsule& whole_A, double far_m) {
  CapsuleContact out;
  if (!is_usable(whole_A)) return out;
  Capsule capsule_A = whole_A;
  const bool ball = capsule_A.p0 == capsule_A.p1;
  if (!ball && std::isfinite(far_m) && !clip_to_box(field, far_m + whole_A.radius, capsule_A))
    return beyond(field, whole_A, far_m);
  const Place lowest =
      ball ? Place{0, field.at(capsule_A.p0)} : LowestPoint(field, capsule_A, far_m).find();
  const double slope = lowest.field.gradient.norm();
  const bool flat = !(slope > 1e-6);
  if (!std::isfinite(slope) || (flat && !field.is_carved())) return out;
  out.status = LpStatus::kOptimal;
  out.gap = lowest.field.distance - capsule_A.radius;
  // Exactly in the middle of a hole each way across the axis is as good as the other.
  const Vec3 along = capsule_A.p1 - capsule_A.p0;
  if (flat)
    out.nhat_AB_A = ball ? Vec3(Vec3::UnitZ()) : Vec3(along.unitOrthogonal());
  else
    out.nhat_AB_A = lowest.field.gradient / slope;
  out.p_axis_A = capsule_A.p0 + lowest.s * (capsule_A.p1 - capsule_A.p0);
  out.p_A = out.p_axis_A - lowest.field.distance * out.nhat_AB_A;
  // What was cut off is beyond far_m, but may be nearer than the rest.
  const bool is_cut = capsule_A.p0 != whole_A.p0 || capsule_A.p1 != whole_A.p1;
  if (is_cut && out.gap > far_m) out.gap = far_m;
  return out;
}

CapsuleContact round_contact(const FieldView& field, const RoundBox& box_A, double far_m) {
  if (!box_A.is_box) return field_contact(field, box_A.rod, far_m);
  CapsuleContact out;
  if (!is_finite(box_A.X)) return out;
  const double radius = box_A.rod.radius;
  const BoxLowest lowest = lowest_of_box(field, box_A.X, box_A.half, far_m + radius);
  const double slope = lowest.field.gradient.norm();
  if (!(slope > 1e-6) || !std::isfinite(slope)) return out;
  out.status = LpStatus::kOptimal;
  out.gap = lowest.field.distance - radius;
  out.nhat_AB_A = lowest.field.gradient / slope;
  out.p_axis_A = lowest.p;
  out.p_A = lowest.p - lowest.field.distance * out.nhat_AB_A;
  return out;
}

}  // namespace osteon
