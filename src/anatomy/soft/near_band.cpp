#include "soft/near_band.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace osteon {
namespace {

constexpr double kRoundings_m = 1e-9;  // far above that of any value

}  // namespace

NearBandSpans::NearBandSpans(const LaidBand& band)
    : band_(&band), last_(band.sections.empty() ? 0 : band.sections.size() - 1) {}

Spread NearBandSpans::span_spread(std::size_t span, const Vicinity& where) const {
  const BandSection& a = band_->sections[span];
  const BandSection& b = band_->sections[span + 1];
  const Vec3 step = b.center - a.center, from_a = where.center - a.center;
  const double share = std::clamp(from_a.dot(step) / step.squaredNorm(), 0.0, 1.0);
  const double d = (from_a - share * step).norm();
  const double widest = std::max({a.half_width, b.half_width, a.half_thickness, b.half_thickness});
  const double thinnest = std::min(a.half_thickness, b.half_thickness);
  const double thicker =
      std::max({0.0, a.half_thickness - a.half_width, b.half_thickness - b.half_width});
  const double skew = 0.25 * (std::abs(a.across.dot(b.flat)) + std::abs(b.across.dot(a.flat)));
  return {d - where.radius - widest - kRoundings_m,
          (d + where.radius) * std::sqrt(1 + skew) - thinnest + thicker + kRoundings_m};
}

NearBandSpans NearBandSpans::within(const Vicinity& where, Spread& values) const {
  values = {1e300, 1e300};
  std::vector<double> least;
  for (std::size_t i = first_; i < last_; ++i) {
    const Spread span = span_spread(i, where);
    least.push_back(span.least);
    values.least = std::min(values.least, span.least);
    values.most = std::min(values.most, span.most);
  }
  NearBandSpans near = *this;
  while (near.first_ + 1 < near.last_ && least[near.first_ - first_] > values.most) ++near.first_;
  while (near.first_ + 1 < near.last_ && least[near.last_ - 1 - first_] > values.most) --near.last_;
  return near;
}

}  // namespace osteon
