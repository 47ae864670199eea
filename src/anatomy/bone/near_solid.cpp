#include "bone/near_solid.h"

#include <algorithm>
#include <cmath>

namespace osteon {
namespace {

constexpr double kRounding_m = 1e-9;  // far above that of any value

Spread about(double value, double radius) {
  return {value - radius - kRounding_m, value + radius + kRounding_m};
}

double norm_in(const Vec3& q, const Vec3& radii) { return q.cwiseQuotient(radii).norm(); }

Spread spread_of(const Ellipsoid& e, const Vicinity& where) {
  const double a = e.radii.minCoeff(), b = e.radii.maxCoeff();
  const double k0 = norm_in(e.R_local * (where.center - e.center), e.radii);
  const double lo = std::max(k0 - where.radius / a, 0.0), hi = k0 + where.radius / a;
  // f = (k0 / k1) (k0 - 1), and k0 / k1 lies between the radii.
  Spread s{(lo > 1 ? a : b) * (lo - 1), (hi > 1 ? b : a) * (hi - 1)};
  if (lo > 0.5) {
    const double q = (b / a) * (b / a), c = 1 + q + q * q;
    const double K = std::sqrt(4 * c * c * c / (27 * (c - 1) * (c - 1)));
    const double slope = (2 - 1 / hi) + K * std::max(1 / lo - 1, 1 - 1 / hi);
    const double f = distance(e, where.center);
    s.least = std::max(s.least, f - slope * where.radius);
    s.most = std::min(s.most, f + slope * where.radius);
  }
  return {s.least - kRounding_m, s.most + kRounding_m};
}

template <class Exact>
Spread spread_of(const Exact& shape, const Vicinity& where) {
  return about(distance(shape, where.center), where.radius);
}

}  // namespace

Spread spread(const Primitive& primitive, const Vicinity& where) {
  return std::visit([&](const auto& shape) { return spread_of(shape, where); }, primitive);
}

Spread smooth_min(const Spread& a, const Spread& b, double k) {
  return {smooth_min(a.least, b.least, k), smooth_min(a.most, b.most, k)};
}

Spread smooth_max(const Spread& a, const Spread& b, double k) {
  return {smooth_max(a.least, b.least, k), smooth_max(a.most, b.most, k)};
}

bool surely_less(const Spread& a, const Spread& b, double k) {
  return b.least > a.most + k + kRounding_m;
}

Spread negated(const Spread& s) { return {-s.most, -s.least}; }

NearSolid::NearSolid(const Solid& solid) {
  for (const Part& part : solid.parts) add(part);
}

NearSolid::NearSolid(const std::vector<const Part*>& parts) {
  for (const Part* part : parts) add(*part);
}

void NearSolid::add(const Part& part) {
  const auto* tube = std::get_if<Tube>(&part.primitive);
  const auto cones = tube ? static_cast<std::uint32_t>(tube->reach.size()) : 0;
  parts_.push_back({&part, !parts_.empty() && part.operation == Operation::kCut, 0, cones});
}

double NearSolid::value(const NearPart& near, const Vec3& p) {
  const auto* tube = std::get_if<Tube>(&near.part->primitive);
  return tube ? distance(*tube, p, near.first, near.last) : distance(near.part->primitive, p);
}

double NearSolid::operator()(const Vec3& p) const {
  double d = value(parts_[0], p);
  if (parts_[0].cuts) d = -d;
  for (std::size_t i = 1; i < parts_.size(); ++i) {
    const double other = value(parts_[i], p);
    const double blend = parts_[i].part->blend;
    d = parts_[i].cuts ? smooth_max(d, -other, blend) : smooth_min(d, other, blend);
  }
  return d;
}

Spread NearSolid::narrow(NearPart& near, const Vicinity& where) {
  const auto* tube = std::get_if<Tube>(&near.part->primitive);
  if (!tube) return spread(near.part->primitive, where);
  const double nearest =
      narrow_cones(*tube, where.center, 2 * (where.radius + kRounding_m), near.first, near.last);
  return about(nearest, where.radius);
}

NearSolid NearSolid::within(const Vicinity& where, Spread& values) const {
  NearSolid near;
  for (NearPart part : parts_) {
    const Spread own = narrow(part, where);
    const double blend = part.part->blend;
    if (near.parts_.empty()) {
      values = part.cuts ? negated(own) : own;
    } else if (part.cuts) {
      if (surely_less(negated(values), own, blend)) continue;
      if (surely_less(own, negated(values), blend)) near.parts_.clear();
      values = smooth_max(values, negated(own), blend);
    } else {
      if (surely_less(values, own, blend)) continue;
      if (surely_less(own, values, blend)) near.parts_.clear();
      values = smooth_min(values, own, blend);
    }
    near.parts_.push_back(part);
  }
  return near;
}

}  // namespace osteon
