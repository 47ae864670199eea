#include "osteon/scene/soft_band.h"

#include <algorithm>
#include <cmath>

#include "osteon/collide/segments.h"

namespace osteon {
namespace {

// Of its length, at either end a band is bone more and more.
constexpr double kEndShare = 0.05;
constexpr int kHalvings = 40;  // of some millimetres: to the last bits that can be felt

double pull_of(const BandFibres& fibres, double length_m) {
  const double strain = length_m / fibres.slack_m - 1;
  if (!(strain > 0)) return 0;
  const double toe = fibres.toe_strain;
  return fibres.stiffness_n * (strain < 2 * toe ? strain * strain / (4 * toe) : strain - toe);
}

double slope_of(const BandFibres& fibres, double length_m) {
  const double strain = length_m / fibres.slack_m - 1;
  if (!(strain > 0)) return 0;
  const double toe = fibres.toe_strain;
  const double per_strain = fibres.stiffness_n * (strain < 2 * toe ? strain / (2 * toe) : 1);
  return per_strain / fibres.slack_m;
}

// A string bent by `bent` across its straight way, `to_a` and `to_b` from its ends.
struct BentString {
  const SoftBand& band;
  double to_a, to_b, taken_by_others_m, left;

  double leg(double along, double bent) const { return std::sqrt(along * along + bent * bent); }
  double taken(double bent) const { return leg(to_a, bent) + leg(to_b, bent) - (to_a + to_b); }
  double tension(double bent) const {
    return tension_at(band, to_a + to_b + taken(bent) + taken_by_others_m + band.over_m, left);
  }
  double force(double bent) const {
    return tension(bent) * bent * (1 / leg(to_a, bent) + 1 / leg(to_b, bent));
  }
};

// bent in [0, deep] with string.force(bent) = k (deep - bent): the left side rises with bent and
// the right one falls, so halving finds the only one.
double balance(const BentString& string, double deep, double k) {
  double low = 0, high = deep;
  for (int i = 0; i < kHalvings; ++i) {
    const double middle = 0.5 * (low + high);
    (string.force(middle) < k * (deep - middle) ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

// The string's force where it is in balance with k (deep - bent). A leg of next to no length has
// any direction: there the force is what the surface bears.
double balanced_n(const BentString& string, double bent, double deep, double k) {
  constexpr double kRounded = 1.001;
  const double force = string.force(bent);
  return force > kRounded * k * deep ? k * (deep - bent) : force;
}

}  // namespace

double tension_at(const SoftBand& band, double length_m, double left) {
  double sum = 0;
  for (const BandFibres& fibres : band.fibres) sum += pull_of(fibres, length_m);
  return left * band.left * sum;
}

double tension_slope_at(const SoftBand& band, double length_m, double left) {
  double sum = 0;
  for (const BandFibres& fibres : band.fibres) sum += slope_of(fibres, length_m);
  return left * band.left * sum;
}

AxisPoints pressed_between(const BandSpan& span, const RoundBox& part_W, const Vec3& nhat_W) {
  const AxisPoints nearest = nearest_on_cores(round_box(Capsule{span.a_W, span.b_W, 0}), part_W);
  if (!part_W.is_box) return nearest;
  const Vec3 way = span.b_W - span.a_W;
  const double length = way.norm();
  const Vec3 across = nhat_W - nhat_W.dot(way) / (length * length) * way;
  const double size = across.norm();
  if (!(length > 0) || !(size > 0)) return nearest;
  const Vec3 n = across / size;
  const OverLine over = lowest_over(part_W, span.a_W, span.b_W, n);
  if (!over.meets) return nearest;
  const Vec3 on_band = span.a_W + over.share * way;
  return {on_band, on_band + over.height * n};
}

// Symbols: n, from the band to the part; q, from the straight band to the part's middle line where
// the two are nearest; the part has come deep = r + R - q.n over the surface.
BandPress press_band(const SoftBand& band, const BandSpan& span, const RoundBox& part_W,
                     const BandContact& contact, double surface_n_per_m) {
  BandPress out;
  const Vec3& n = contact.nhat_W;
  const AxisPoints pair = pressed_between(span, part_W, n);
  out.p_W = pair.b - part_W.rod.radius * n;
  out.deep_m = band.radius_m + part_W.rod.radius - n.dot(pair.b - pair.a);
  const double to_a = (pair.a - span.a_W).norm(), to_b = (pair.a - span.b_W).norm();
  const double at_end = std::min(1.0, std::min(to_a, to_b) / (kEndShare * (to_a + to_b)));
  if (!(out.deep_m > 0) || !(at_end > 0) || !std::isfinite(to_a + to_b)) return out;
  const BentString string{band, to_a, to_b, contact.others_taken_m, contact.left};
  const double k = at_end * surface_n_per_m;
  out.bent_m = balance(string, out.deep_m, k);
  out.taken_m = string.taken(out.bent_m);
  out.tension_n = string.tension(out.bent_m);
  out.force_n = balanced_n(string, out.bent_m, out.deep_m, k);
  out.presses = true;
  return out;
}

BandPress draw_band(const SoftBand& band, const BandSpan& span, const Vec3& to_W,
                    double others_taken_m, double spring_n_per_m, double left) {
  BandPress out;
  const Vec3 way = span.b_W - span.a_W;
  const double length = way.norm();
  if (!(length > 0) || !is_finite(to_W) || !(spring_n_per_m > 0)) return out;
  const double share = std::clamp((to_W - span.a_W).dot(way) / (length * length), 0.0, 1.0);
  const Vec3 on_W = span.a_W + share * way;
  const double apart = (to_W - on_W).norm();
  out.p_W = on_W;
  out.deep_m = apart - band.radius_m;
  const double at_end = std::min(1.0, std::min(share, 1 - share) / kEndShare);
  if (!(out.deep_m > 0) || !(at_end > 0)) return out;
  const BentString string{band, share * length, (1 - share) * length, others_taken_m, left};
  const double k = at_end * spring_n_per_m;
  out.bent_m = balance(string, out.deep_m, k);
  out.taken_m = string.taken(out.bent_m);
  out.tension_n = string.tension(out.bent_m);
  out.force_n = balanced_n(string, out.bent_m, out.deep_m, k);
  out.p_W = on_W + out.bent_m / apart * (to_W - on_W);
  out.presses = true;
  return out;
}

}  // namespace osteon
