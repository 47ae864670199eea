#include "osteon/collide/capsule_contact.h"

#include <algorithm>
#include <cmath>

#include "block_scan.h"
#include "distance_search.h"

namespace osteon {
namespace {

constexpr int kMostSteps = 100;
constexpr double kTouching = 1e-12;  // share of the body's size that counts as no distance

DifferencePoint farthest_against(const ConvexBody& a, const Capsule& c, const Vec3& v) {
  std::uint32_t vertex = 0;
  support(a, -v, &vertex);
  const Vec3 p_a = a.vertex(vertex);
  const bool at_p1 = v.dot(c.p0) < v.dot(c.p1);
  const Vec3& p_ax = at_p1 ? c.p1 : c.p0;
  return {p_a - p_ax, p_a, p_ax, 2 * vertex + (at_p1 ? 1 : 0)};
}

// The vertices and ends that carried the nearest point last, where they are now: mostly they still
// do. Any of them make a simplex to begin with; a name that is none of this body's is passed over.
void recall_simplex(const ConvexBody& a, const Capsule& c, const LpBasis& basis,
                    NearestSimplex& simplex) {
  for (std::uint8_t k = 0; k < std::min<std::uint8_t>(basis.count, 3); ++k) {
    const std::uint32_t id = basis.rows[k];
    if (id / 2 >= a.vx.size()) continue;
    const Vec3 p_a = a.vertex(id / 2);
    const Vec3& p_ax = id % 2 ? c.p1 : c.p0;
    add_point(simplex, {p_a - p_ax, p_a, p_ax, id});
  }
}

void keep_simplex(const NearestSimplex& simplex, LpBasis& basis) {
  basis = {};
  basis.count = static_cast<std::uint8_t>(simplex.count);
  for (std::size_t k = 0; k < simplex.count; ++k) basis.rows[k] = simplex.points[k].id;
}

// Distance of the axis from the body; false when they meet.
bool apart(const ConvexBody& a, const Capsule& c, LpBasis* basis, CapsuleContact& out) {
  DistanceSearch search;
  if (basis) recall_simplex(a, c, *basis, search.simplex);
  const auto farthest = [&](const Vec3& v) { return farthest_against(a, c, v); };
  const bool found =
      search_distance(a.center - 0.5 * (c.p0 + c.p1), kTouching * a.radius, farthest, search);
  out.steps = search.steps;
  if (basis) *basis = {};
  if (!found) return false;
  if (basis) keep_simplex(search.simplex, *basis);
  out.status = search.ended ? LpStatus::kOptimal : LpStatus::kPivotLimit;
  out.nhat_AB_A = -search.v / search.distance;
  out.gap = search.distance - c.radius;
  out.p_A = search.simplex.on_body();
  out.p_axis_A = search.simplex.on_axis();
  return true;
}

// A facet's height over the axis: value + slope s at p0 + s (p1 - p0).
struct Line {
  std::uint32_t plane = Excess::kNone;
  double value = 0, slope = 0;
  double at(double s) const { return value + s * slope; }
};

class AxisProgramme {
 public:
  AxisProgramme(const ConvexBody& a, const Capsule& c)
      : a_(a), c_(c), along_(c.p1 - c.p0), low_(highest_at(0)), high_(highest_at(1)) {}

  CapsuleContact solve() {
    CapsuleContact out;
    double s = end_if_there();
    while (s < 0) {
      s = meeting();
      const Line top = highest_at(s);
      const double level = low_.at(s);
      const bool done = !(top.at(s) > level + kTouching * a_.radius) || ++out.steps > kMostSteps;
      if (done) break;
      (top.slope < 0 ? low_ : high_) = top;
      s = -1;
    }
    finish(out, s);
    return out;
  }

 private:
  Line highest_at(double s) const {
    const Vec3 x = c_.p0 + s * along_;
    const Excess e = most_exceeded(a_, x - a_.center, -std::numeric_limits<double>::infinity());
    const Vec3 n = a_.normal(e.plane);
    return {e.plane, n.dot(c_.p0) - a_.d[e.plane], n.dot(along_)};
  }
  // The optimum at an end of the axis, else -1.
  double end_if_there() {
    if (low_.slope >= 0) {
      high_ = low_;
      return 0;
    }
    if (high_.slope <= 0) {
      low_ = high_;
      return 1;
    }
    return -1;
  }
  double meeting() const {
    return std::clamp((high_.value - low_.value) / (low_.slope - high_.slope), 0.0, 1.0);
  }
  // The two facets' normals weighted so that their mean does not change along the axis.
  void finish(CapsuleContact& out, double s) const {
    const double spread = high_.slope - low_.slope;
    const double share = spread > 0 ? -low_.slope / spread : 0;
    const Vec3 n = (1 - share) * a_.normal(low_.plane) + share * a_.normal(high_.plane);
    const double length = n.norm();
    out.status = length > 1e-9 ? LpStatus::kOptimal : LpStatus::kNumerical;
    if (!(length > 1e-9)) return;
    out.nhat_AB_A = n / length;
    const double lowest = std::min(out.nhat_AB_A.dot(c_.p0), out.nhat_AB_A.dot(c_.p1));
    out.gap = lowest - support(a_, out.nhat_AB_A) - c_.radius;
    out.p_axis_A = c_.p0 + s * along_;
    out.p_A = out.p_axis_A;
  }

  const ConvexBody& a_;
  const Capsule& c_;
  Vec3 along_;
  Line low_, high_;
};

bool is_capsule(const Capsule& c) {
  return is_finite(c.p0) && is_finite(c.p1) && std::isfinite(c.radius) && c.radius >= 0;
}

}  // namespace

CapsuleContact capsule_contact(const ConvexBody& a, const Capsule& capsule_A, LpBasis* basis) {
  CapsuleContact out;
  if (!is_capsule(capsule_A) || apart(a, capsule_A, basis, out)) return out;
  return AxisProgramme(a, capsule_A).solve();
}

}  // namespace osteon
