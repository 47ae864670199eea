// Symbols: x, along the straight way, from the cut; r, distance of a surface point from it, towards
// n. In the cut the point goes inwards by the share of r by which the strands there are gone; the
// ends of cut strands draw back, so the groove is a wedge, wider above than below.
#include "soft/notched_band.h"

#include <algorithm>
#include <cmath>

#include "osteon/physics/band_strands.h"

namespace osteon {
namespace {

constexpr double kFloor_m = 0.0008;  // half of the groove's width at its bottom
constexpr double kSlope = 0.6;       // of half its width, for its depth
constexpr double kDeepest = 1.8;     // of r: beyond the middle, and never through the other side
constexpr double kOnLine_m = 1e-6;

}  // namespace

std::vector<Vec3> notched_points(std::span<const Vec3> points_W, const SoftBand& band,
                                 const BandSpan& rest_W, const StrandAxes& section,
                                 const BandNotch& notch) {
  std::vector<Vec3> out(points_W.begin(), points_W.end());
  const Vec3 way = rest_W.b_W - rest_W.a_W;
  const double length = way.norm();
  if (!(length > kOnLine_m) || !std::isfinite(notch.share)) return out;
  const Vec3 along = way / length;
  for (Vec3& p : out) {
    const Vec3 from_a = p - rest_W.a_W;
    const double at = from_a.dot(along);
    const Vec3 aside = from_a - at * along;
    const double r = aside.norm();
    if (!(r > kOnLine_m) || !(at > 0 && at < length)) continue;
    const Vec3 n = aside / r;
    const double deep =
        std::min(r / band.radius_m * hollow_m(band, notch.gone, section, n), kDeepest * r);
    const double x = std::abs(at - notch.share * length) - kFloor_m;
    const double left = x > 0 ? deep - x / kSlope : deep;
    if (left > 0) p -= left * n;
  }
  return out;
}

}  // namespace osteon
