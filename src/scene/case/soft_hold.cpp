#include "osteon/scene/soft_hold.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "osteon/scene/soft_band.h"

namespace osteon {
namespace {

constexpr double kShortestLeg_m = 1e-6;
constexpr int kNewtonSteps = 40, kShortenings = 30;
constexpr double kStill_n = 1e-9;
constexpr double kDescends = 0.1;  // of what the slope promises

// One leg: its fibres have `share` of the band's length, so its strain is that of a band of
// (l + behind) / share + others.
struct HeldLeg {
  const SoftBand& band;
  Vec3 end_W;
  double share, behind_m, others_m, left;

  double whole(double l) const { return (l + behind_m) / share + others_m; }
  double tension(double l) const { return tension_at(band, whole(l), left); }
  double slope(double l) const { return tension_slope_at(band, whole(l), left) / share; }
  // Pull on the place h, and the curvature that its energy has there.
  void add(const Vec3& h, Vec3& force, Mat3& curve) const {
    const Vec3 way = h - end_W;
    const double l = way.norm();
    if (!(l > kShortestLeg_m)) return;
    const Vec3 n = way / l;
    const double t = tension(l);
    force -= t * n;
    curve += slope(l) * n * n.transpose() + t / l * (Mat3::Identity() - n * n.transpose());
  }
};

struct HeldString {
  HeldLeg first, second;
  Vec3 grip_W;
  double k;

  Vec3 force(const Vec3& h, Mat3& curve) const {
    Vec3 sum = k * (grip_W - h);
    curve = k * Mat3::Identity();
    first.add(h, sum, curve);
    second.add(h, sum, curve);
    return sum;
  }
};

}  // namespace

// Symbols: h, the held place; E(h), the energy of both legs and of the spring from h to the jaws.
// Legs only pull, so E is convex, and with the spring strictly so: it has one lowest place.
// Newton's steps go down towards it, d = H^-1 F for the force F = -dE/dh and the curvature H >= k;
// a step is halved until the slope along d, -F(h + s d).d, has not grown beyond a tenth of what it
// was with the other sign, which holds for a step short enough. Ends when F is nothing, or after so
// many steps: then h is on its way, and the force of the spring is still bounded by k |grip - h|.
HeldBand hold_band(const SoftBand& band, const BandSpan& span, const Vec3& grip_W,
                   const SoftHold& hold, double spring_n_per_m) {
  HeldBand out;
  const double share = hold.share;
  if (!is_finite(grip_W) || !(share > 0 && share < 1) || !(spring_n_per_m > 0)) return out;
  const double others_m = hold.others_taken_m;
  const HeldString string{{band, span.a_W, share, 0, others_m, hold.left},
                          {band, span.b_W, 1 - share, band.over_m, others_m, hold.left},
                          grip_W,
                          spring_n_per_m};
  Vec3 h = grip_W;
  Mat3 curve;
  Vec3 force = string.force(h, curve);
  for (int i = 0; i < kNewtonSteps && force.norm() > kStill_n; ++i) {
    const Vec3 d = curve.inverse() * force;
    const double down = force.dot(d);
    double s = 1;
    for (int n = 0; n < kShortenings; ++n, s *= 0.5) {
      if (string.force(h + s * d, curve).dot(d) >= -kDescends * down) break;
    }
    h += s * d;
    force = string.force(h, curve);
  }
  const double to_a = (h - span.a_W).norm(), to_b = (h - span.b_W).norm();
  out.held_W = h;
  out.force_W = -spring_n_per_m * (grip_W - h);
  out.tension_n = std::max(string.first.tension(to_a), string.second.tension(to_b));
  out.taken_m = to_a + to_b - (span.b_W - span.a_W).norm();
  if (!is_finite(h) || !std::isfinite(out.tension_n)) return {};
  return out;
}

}  // namespace osteon
