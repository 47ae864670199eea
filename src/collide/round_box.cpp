#include "osteon/collide/round_box.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

namespace osteon {
namespace {

constexpr double kRoundest_m = 0.0005;
constexpr double kNearly_m = 0.0001;  // so much higher counts a quarter as much

struct Segment {
  Vec3 p0 = Vec3::Zero(), p1 = Vec3::Zero();
};

Vec3 clamped(const Vec3& p, const Vec3& half) { return p.cwiseMax(-half).cwiseMin(half); }

// Symbols: p(t) = p0 + t d, 0 <= t <= 1, in the box' frame; e(t) is what of p(t) lies outside of
// the box, so that |e(t)| is its distance. Invariant: g(t) = e(t).d, half the slope of |e|^2, never
// falls and is straight between the (at most six) places where p(t) passes a side's plane. So the
// nearest place is where g passes zero; where g is zero over a stretch, the first of it. Ends: one
// pass over the places.
double nearest_on_segment(const Segment& s, const Vec3& half) {
  const Vec3 d = s.p1 - s.p0;
  const auto slope = [&](double t) {
    const Vec3 p = s.p0 + t * d;
    return (p - clamped(p, half)).dot(d);
  };
  std::array<double, 8> at{};
  std::size_t count = 0;
  for (Eigen::Index k = 0; k < 3; ++k)
    for (const double side : {-half[k], half[k]}) {
      const double t = d[k] != 0 ? (side - s.p0[k]) / d[k] : -1;
      if (t > 0 && t < 1) at[count++] = t;
    }
  std::sort(at.begin(), at.begin() + static_cast<std::ptrdiff_t>(count));
  at[count++] = 1;
  double from = 0, g_from = slope(0);
  if (!(g_from < 0)) return 0;
  for (std::size_t i = 0; i < count; ++i) {
    const double g = slope(at[i]);
    if (!(g < 0)) return from + (at[i] - from) * std::clamp(g_from / (g_from - g), 0.0, 1.0);
    from = at[i];
    g_from = g;
  }
  return 1;
}

// Nearest points of a segment (first) and a box' core.
AxisPoints nearest(const Segment& s, const RoundBox& box) {
  const Pose X_BW = box.X.inverse();
  const Segment s_B{X_BW * s.p0, X_BW * s.p1};
  const double t = nearest_on_segment(s_B, box.half);
  const Vec3 p_B = s_B.p0 + t * (s_B.p1 - s_B.p0);
  return {s.p0 + t * (s.p1 - s.p0), box.X * clamped(p_B, box.half)};
}

double squared(const AxisPoints& points) { return (points.a - points.b).squaredNorm(); }

// The edges of a core, each once; of a flat one, some are the same or points.
std::array<Segment, 12> edges_of(const RoundBox& box) {
  std::array<Segment, 12> edges;
  std::size_t count = 0;
  for (Eigen::Index k = 0; k < 3; ++k)
    for (const double i : {-1.0, 1.0})
      for (const double j : {-1.0, 1.0}) {
        Vec3 p = box.half;
        p[(k + 1) % 3] *= i;
        p[(k + 2) % 3] *= j;
        Vec3 q = p;
        q[k] = -q[k];
        edges[count++] = {box.X * p, box.X * q};
      }
  return edges;
}

struct PlanePoint {
  double along = 0, height = 0;
};

// The corners of the core's section with the plane through `a` across `side`.
std::size_t section_of(const RoundBox& box, const Vec3& a, const Vec3& along, const Vec3& n,
                       std::array<PlanePoint, 24>& out) {
  const Vec3 side = along.cross(n);
  std::size_t count = 0;
  for (const Segment& edge : edges_of(box)) {
    const double from = side.dot(edge.p0 - a), to = side.dot(edge.p1 - a);
    if ((from > 0 && to > 0) || (from < 0 && to < 0)) continue;
    const double t = from != to ? from / (from - to) : 0;
    const Vec3 p = edge.p0 + t * (edge.p1 - edge.p0) - a;
    out[count++] = {along.dot(p), n.dot(p)};
    if (from == to) {  // the whole edge lies in the plane
      const Vec3 q = edge.p1 - a;
      out[count++] = {along.dot(q), n.dot(q)};
    }
  }
  return count;
}

AxisPoints swapped(const AxisPoints& points) { return {points.b, points.a}; }

}  // namespace

RoundBox round_box(const Primitive& part) {
  if (part.kind == Primitive::Kind::kRod) return round_box(part.rod);
  const double radius = std::min(part.half.minCoeff(), kRoundest_m);
  const Vec3& middle = part.X_TB.p;
  return {{middle, middle, radius}, true, part.X_TB, part.half - Vec3::Constant(radius)};
}

RoundBox placed(const Pose& X, const RoundBox& box) {
  RoundBox out = box;
  out.rod.p0 = X * box.rod.p0;
  out.rod.p1 = X * box.rod.p1;
  if (box.is_box) out.X = X * box.X;
  return out;
}

double reach_of(const RoundBox& box) {
  const double core = box.is_box ? box.half.norm() : 0.5 * (box.rod.p1 - box.rod.p0).norm();
  return core + box.rod.radius;
}

double highest(const RoundBox& box, const Vec3& n) {
  if (!box.is_box) return std::max(n.dot(box.rod.p0), n.dot(box.rod.p1)) + box.rod.radius;
  const Vec3 n_B = box.X.q.conjugate() * n;
  return n.dot(box.X.p) + n_B.cwiseAbs().dot(box.half) + box.rod.radius;
}

double lowest(const RoundBox& box, const Vec3& n) { return -highest(box, -n); }

// Symbols: the section's corners p_i at (along_i, height_i); what of the section lies over the line
// has its lowest place at a corner over the line, or where the section's border passes an end of
// the line, which is on the segment between two corners. The share is the mean of these places,
// each by 1 / (1 + what it is higher / kNearly_m)^2: none of them counts of a sudden.
OverLine lowest_over(const RoundBox& box, const Vec3& a, const Vec3& b, const Vec3& n) {
  OverLine out;
  const double length = (b - a).norm();
  const Vec3 along = (b - a) / length;
  std::array<PlanePoint, 24> corners{};
  const std::size_t count = section_of(box, a, along, n, corners);
  std::array<PlanePoint, 24> places{};
  std::size_t found = 0;
  const auto is_over = [&](const PlanePoint& p) { return p.along >= 0 && p.along <= length; };
  for (std::size_t i = 0; i < count; ++i)
    if (is_over(corners[i])) places[found++] = corners[i];
  for (const double end : {0.0, length}) {
    PlanePoint low{end, std::numeric_limits<double>::infinity()};
    for (std::size_t i = 0; i < count; ++i)
      for (std::size_t j = 0; j < count; ++j) {
        const PlanePoint &p = corners[i], &q = corners[j];
        if (!(p.along < end && q.along > end)) continue;
        const double t = (end - p.along) / (q.along - p.along);
        low.height = std::min(low.height, p.height + t * (q.height - p.height));
      }
    if (std::isfinite(low.height) && found < places.size()) places[found++] = low;
  }
  if (found == 0) return out;
  out.meets = true;
  out.height = places[0].height;
  for (std::size_t i = 1; i < found; ++i) out.height = std::min(out.height, places[i].height);
  double sum = 0, weights = 0;
  for (std::size_t i = 0; i < found; ++i) {
    const double near = 1 + (places[i].height - out.height) / kNearly_m;
    sum += places[i].along / (near * near);
    weights += 1 / (near * near);
  }
  out.share = std::clamp(sum / weights / length, 0.0, 1.0);
  return out;
}

// Of two polyhedra that do not meet, one of the nearest points lies on an edge, at least: a face's
// inner point is nearest to a corner, or to an edge beside it as well.
AxisPoints nearest_on_cores(const RoundBox& a, const RoundBox& b) {
  if (!a.is_box && !b.is_box) return nearest_on_axes(a.rod, b.rod);
  if (!a.is_box) return nearest({a.rod.p0, a.rod.p1}, b);
  if (!b.is_box) return swapped(nearest({b.rod.p0, b.rod.p1}, a));
  const std::array<Segment, 12> edges_a = edges_of(a);
  AxisPoints best = nearest(edges_a[0], b);
  for (const Segment& edge : edges_a)
    if (const AxisPoints points = nearest(edge, b); squared(points) < squared(best)) best = points;
  for (const Segment& edge : edges_of(b))
    if (const AxisPoints points = swapped(nearest(edge, a)); squared(points) < squared(best))
      best = points;
  return best;
}

}  // namespace osteon
