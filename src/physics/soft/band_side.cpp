#include "soft/band_side.h"

#include <cmath>

#include "osteon/collide/segments.h"

namespace osteon {
namespace {

constexpr double kCosTurn = 0.99500416527802577, kSinTurn = 0.099833416646828152;  // of 0.1 rad
// A part counts as beyond the band where it is so much more behind than beside it.
constexpr double kBehind = -0.3;
// Nearer than this share of the radii the line between the two says little of the side.
constexpr double kVague = 0.3;
constexpr double kCrossing = 0.05;  // sine of the angle between band and part

struct Meeting {
  Vec3 q_W = Vec3::Zero();       // from the band's middle line to the part's
  Vec3 along_W = Vec3::UnitX();  // of the band
  Vec3 across_W = Vec3::Zero();  // common normal of lines that cross; else zero
};

bool within(const Vec3& p, const Vec3& from, const Vec3& to) {
  const Vec3 way = to - from;
  const double share = (p - from).dot(way);
  return share > 1e-9 * way.squaredNorm() && share < (1 - 1e-9) * way.squaredNorm();
}

Meeting meet(const BandSpan& span, const RoundBox& shape) {
  Meeting out;
  const AxisPoints pair = nearest_on_cores(round_box(Capsule{span.a_W, span.b_W, 0}), shape);
  out.q_W = pair.b - pair.a;
  out.along_W = (span.b_W - span.a_W).normalized();
  const Capsule& part = shape.rod;
  if (!shape.is_box && within(pair.a, span.a_W, span.b_W) && within(pair.b, part.p0, part.p1)) {
    const Vec3 cross = out.along_W.cross((part.p1 - part.p0).normalized());
    if (cross.norm() > kCrossing) out.across_W = cross.normalized();
  }
  return out;
}

Vec3 across(const Vec3& n, const Vec3& along, const Vec3& otherwise) {
  const Vec3 flat = n - n.dot(along) * along;
  const double size = flat.norm();
  return size > 1e-6 ? Vec3(flat / size) : otherwise;
}

// From n towards `target` on the shorter way.
Vec3 turned(const Vec3& n, const Vec3& target) {
  const Vec3 aside = target - target.dot(n) * n;
  const double size = aside.norm();
  if (target.dot(n) > 0 && size <= kSinTurn) return target;
  return size > 1e-12 ? Vec3(kCosTurn * n + (kSinTurn / size) * aside) : n;
}

}  // namespace

BandSide first_side(const SoftBand& band, const BandSpan& span, const RoundBox& part_W) {
  const Meeting met = meet(span, part_W);
  const double apart = met.q_W.norm();
  BandSide out;
  out.nhat_W = apart > 1e-9 ? Vec3(met.q_W / apart) : met.along_W.unitOrthogonal();
  out.gap_m = apart - band.radius_m - part_W.rod.radius;
  return out;
}

BandSide next_side(const SoftBand& band, const BandSpan& span, const RoundBox& part_W,
                   const Vec3& nhat_W) {
  const Meeting met = meet(span, part_W);
  const double apart = met.q_W.norm(), radii = band.radius_m + part_W.rod.radius;
  BandSide out;
  out.beyond = met.q_W.dot(nhat_W) < kBehind * apart;
  const bool clear = !out.beyond && apart >= radii;
  Vec3 target = nhat_W;
  if (!met.across_W.isZero(0))
    target = met.across_W.dot(nhat_W) < 0 ? Vec3(-met.across_W) : met.across_W;
  else if (apart > kVague * radii)
    target = (out.beyond ? -1 : 1) / apart * met.q_W;
  if (clear && apart > 0) target = met.q_W / apart;
  out.nhat_W = clear ? target : turned(nhat_W, across(target, met.along_W, nhat_W));
  const AxisPoints pressed = pressed_between(span, part_W, out.nhat_W);
  out.gap_m = out.nhat_W.dot(pressed.b - pressed.a) - radii;
  return out;
}

}  // namespace osteon
