// Symbols: x, along the straight way from a (0) to b (L); s, the place that is pressed; d, how far
// the middle line goes aside, against n: b x / s before s and b (L - x) / (L - s) after it, rounded
// by a parabola within w of s. A section goes with d and turns by its slope's angle t: a point that
// lies o towards n goes to o cos t along n and by o sin t along the way. The turn comes in within w
// of the ends, so that the surface is whole at the footprints.
#include "soft/bent_band.h"

#include <algorithm>
#include <cmath>

#include "osteon/base/turn.h"

namespace osteon {
namespace {

constexpr double kShortestSpan_m = 1e-6;
constexpr double kLeastLeg = 0.05;    // share of the way between a bend and an end
constexpr double kMostDent = 0.8;     // of what a surface point lies towards the tool
constexpr double kCornerShare = 0.5;  // of the part's and band's radius, the bend's
constexpr double kWidestRound = 0.5;  // of a leg

struct SectionCourse {
  double aside = 0, slope = 0;
};

struct SectionBend {
  double length, s, bent, dent, round, corner;
  Vec3 nhat;

  SectionBend(const StringBend& from, const BandSpan& rest_W) {
    const Vec3 way = rest_W.b_W - rest_W.a_W;
    length = way.norm();
    s = length * std::clamp(from.share, kLeastLeg, 1 - kLeastLeg);
    bent = from.bent_m;
    dent = from.dent_m;
    round = std::min(from.round_m, kWidestRound * std::min(s, length - s));
    corner = kCornerShare * round;
    // As the bones stand the string may have turned from where it is at rest.
    const Vec3 along = way / length;
    const Vec3 n = turn_between(from.along_W, along) * from.nhat_W;
    nhat = (n - n.dot(along) * along).normalized();
  }
  SectionCourse at(double x) const {
    const double m1 = bent / s, m2 = -bent / (length - s), u = x - s;
    if (u < -corner) return {m1 * x, m1};
    if (u > corner) return {bent + m2 * u, m2};
    const double middle = 0.5 * (m1 + m2), change = (m2 - m1) / (4 * corner);
    return {bent + change * corner * corner + middle * u + change * u * u, middle + 2 * change * u};
  }
  double ends_turn(double x) const {
    const double t = std::clamp(std::min(x, length - x) / round, 0.0, 1.0);
    return t * t * (3 - 2 * t);
  }
  // 1 under the part, 0 at twice its radius and the band's.
  double dented(double x) const {
    const double u = (x - s) / (2 * round);
    const double left = 1 - u * u;
    return left > 0 ? left * left : 0;
  }
  Vec3 moved_by(const Vec3& from_a, const Vec3& along) const {
    const double x = from_a.dot(along), o = from_a.dot(nhat);
    const SectionCourse course = at(x);
    const double slope = ends_turn(x) * course.slope, c = 1 / std::sqrt(1 + slope * slope);
    const double pressed = std::clamp(dent * dented(x), 0.0, std::max(0.0, kMostDent * o));
    return (o * (c - 1) - course.aside - pressed) * nhat + o * slope * c * along;
  }
};

bool is_sound(const StringBend& bend) {
  return is_finite(bend.nhat_W) && is_finite(bend.along_W) && std::isfinite(bend.share) &&
         std::isfinite(bend.dent_m) && std::isfinite(bend.bent_m) && bend.bent_m >= 0 &&
         bend.round_m > 0;
}

}  // namespace

std::vector<Vec3> bent_points(std::span<const Vec3> points_W, const BandSpan& rest_W,
                              std::span<const StringBend> bends) {
  std::vector<Vec3> out(points_W.begin(), points_W.end());
  const Vec3 way = rest_W.b_W - rest_W.a_W;
  const double length = way.norm();
  if (!(length > kShortestSpan_m)) return out;
  const Vec3 along = way / length;
  for (const StringBend& from : bends) {
    if (!is_sound(from)) continue;
    const SectionBend bend(from, rest_W);
    if (!is_finite(bend.nhat)) continue;
    for (std::size_t i = 0; i < out.size(); ++i) {
      const Vec3 from_a = points_W[i] - rest_W.a_W;
      const double x = from_a.dot(along);
      if (x > 0 && x < length) out[i] += bend.moved_by(from_a, along);
    }
  }
  return out;
}

}  // namespace osteon
