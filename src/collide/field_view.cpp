#include "osteon/collide/field_view.h"

#include <algorithm>
#include <cmath>

namespace osteon {
namespace {

// Two planes so nearly alike have no edge between them.
constexpr double kAlike = 1e-4;

// A slope shorter than this is none wall's: walls on several sides are about as near.
constexpr double kSteep = 0.9;

// Unit where there is one wall; shorter, and without a jump to nothing, where there are several.
Vec3 normal_of(const Vec3& slope) { return slope / std::max(slope.norm(), kSteep); }

}  // namespace

// a, b: heights over the two planes, m and n their normals, c = m.n. The edge is nearest where the
// foot on each plane is outside of the other: a > b c and b > a c. Its distance d follows from
// x = s m + t n with m.x = a, n.x = b, and d^2 = |x|^2 = (a^2 + b^2 - 2 a b c) / (1 - c^2).
// In the middle of a hole the walls all round are as near as each other: there n goes to nothing,
// so that c, and with it d, has no jump.
FieldSample FieldView::carved(const FieldSample& bone, const Vec3& p_B) const {
  FieldSample cut;
  if (!cuts_->height(p_B, cut)) return bone;
  const FieldSample& higher = cut.distance > bone.distance ? cut : bone;
  const double a = bone.distance, b = cut.distance;
  if (!(a > 0 && b > 0)) return higher;
  const Vec3 m = normal_of(bone.gradient), n = normal_of(cut.gradient);
  const double c = m.dot(n), apart = 1 - c * c;
  if (!(a > b * c && b > a * c) || apart < kAlike) return higher;
  const double s = (a - b * c) / apart, t = (b - a * c) / apart;
  const Vec3 x = s * m + t * n;
  const double size = x.norm();
  if (!(size > 0)) return higher;
  return {std::sqrt((a * a + b * b - 2 * a * b * c) / apart), x / size, bone.near && cut.near};
}

// Of a place outside of both the edge counts, for which slopes are needed.
double FieldView::carved_distance(const Vec3& p_B) const {
  const double bone = bone_.distance_at(p_B);
  double cut = 0;
  if (!cuts_->distance(p_B, cut)) return bone;
  if (bone > 0 && cut > 0) return again(p_B).distance;
  return cut > bone ? cut : bone;
}

}  // namespace osteon
