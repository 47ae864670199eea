#include "tunnel_fill.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>

namespace osteon::tunnel {
namespace {

using Loop = std::vector<FlatPoint>;

double twice_area(const Loop& loop) {
  double sum = 0;
  for (std::size_t i = 0; i < loop.size(); ++i) {
    const Vec2 a = loop[i].at - loop[0].at;
    const Vec2 b = loop[(i + 1) % loop.size()].at - loop[0].at;
    sum += a.x() * b.y() - a.y() * b.x();
  }
  return sum;
}

const FlatPoint* find_point(const std::vector<FlatPoint>& sorted, std::uint32_t vertex) {
  const auto at =
      std::lower_bound(sorted.begin(), sorted.end(), vertex,
                       [](const FlatPoint& p, std::uint32_t wanted) { return p.vertex < wanted; });
  return at != sorted.end() && at->vertex == vertex ? &*at : nullptr;
}

/// The loops that the sides run along; none where some side has no one next.
std::optional<std::vector<Loop>> trace(const std::vector<FlatPoint>& points,
                                       std::vector<Side> sides) {
  std::sort(sides.begin(), sides.end());
  std::vector<bool> used(sides.size(), false);
  std::vector<Loop> loops;
  for (std::size_t first = 0; first < sides.size(); ++first) {
    if (used[first]) continue;
    Loop loop;
    std::size_t at = first;
    while (!used[at]) {
      used[at] = true;
      const FlatPoint* p = find_point(points, sides[at].first);
      if (!p) return std::nullopt;
      loop.push_back(*p);
      const auto next = std::lower_bound(sides.begin(), sides.end(), Side{sides[at].second, 0});
      if (next == sides.end() || next->first != sides[at].second) return std::nullopt;
      at = static_cast<std::size_t>(next - sides.begin());
    }
    if (at != first || loop.size() < 3) return std::nullopt;
    loops.push_back(std::move(loop));
  }
  return loops;
}

bool holds(const Loop& loop, const Vec2& p) {
  bool inside = false;
  for (std::size_t i = 0, j = loop.size() - 1; i < loop.size(); j = i++) {
    const Vec2 &a = loop[i].at, &b = loop[j].at;
    if ((a.y() > p.y()) == (b.y() > p.y())) continue;
    if (p.x() < (b.x() - a.x()) * (p.y() - a.y()) / (b.y() - a.y()) + a.x()) inside = !inside;
  }
  return inside;
}

std::size_t rightmost(const Loop& loop) {
  std::size_t best = 0;
  for (std::size_t i = 1; i < loop.size(); ++i)
    if (loop[i].at.x() > loop[best].at.x()) best = i;
  return best;
}

struct Hit {
  double x = std::numeric_limits<double>::infinity();
  std::size_t edge = 0;
  bool found() const { return std::isfinite(x); }
};

/// Where a ray from p to the right first leaves `loop`.
Hit cast_right(const Loop& loop, const Vec2& p) {
  Hit hit;
  for (std::size_t i = 0; i < loop.size(); ++i) {
    const Vec2 &a = loop[i].at, &b = loop[(i + 1) % loop.size()].at;
    if (!(a.y() <= p.y() && p.y() < b.y())) continue;  // the region is on the left
    const double x = a.x() + (b.x() - a.x()) * (p.y() - a.y()) / (b.y() - a.y());
    if (x < p.x() || x >= hit.x) continue;
    hit = {x, i};
  }
  return hit;
}

/// A corner of `loop` that p sees: an end of the edge hit, or a corner that stands before it.
std::size_t seen_from(const Loop& loop, const Vec2& p, const Hit& hit) {
  const std::size_t n = loop.size();
  const std::size_t a = hit.edge, b = (hit.edge + 1) % n;
  std::size_t best = loop[a].at.x() > loop[b].at.x() ? a : b;
  const Vec2 q(hit.x, p.y());
  const Vec2 far = loop[best].at;
  const bool up = far.y() > p.y();
  double best_slope = std::abs(far.y() - p.y()) / std::max(far.x() - p.x(), 1e-300);
  for (std::size_t i = 0; i < n; ++i) {
    const Vec2& c = loop[i].at;
    if (i == a || i == b || c.x() <= p.x()) continue;
    const double s0 = up ? turn(p, q, c) : turn(q, p, c);
    const double s1 = up ? turn(q, far, c) : turn(far, q, c);
    const double s2 = up ? turn(far, p, c) : turn(p, far, c);
    if (s0 < 0 || s1 < 0 || s2 < 0) continue;
    const double slope = std::abs(c.y() - p.y()) / (c.x() - p.x());
    if (slope >= best_slope) continue;
    // Of the copies that a bridge made, the one whose corner opens towards p.
    if (turn(loop[(i + n - 1) % n].at, c, loop[(i + 1) % n].at) > 0) continue;
    best = i;
    best_slope = slope;
  }
  return best;
}

/// Whether p lies within the corner of the loop at i, the region on the left.
bool opens_towards(const Loop& loop, std::size_t i, const Vec2& p) {
  const std::size_t n = loop.size();
  const Vec2 &before = loop[(i + n - 1) % n].at, &c = loop[i].at, &after = loop[(i + 1) % n].at;
  const bool left_of_both = turn(before, c, p) > 0 && turn(c, after, p) > 0;
  const bool left_of_one = turn(before, c, p) > 0 || turn(c, after, p) > 0;
  return turn(before, c, after) > 0 ? left_of_both : left_of_one;
}

bool add_hole(Loop& outer, const Loop& hole) {
  const std::size_t from = rightmost(hole);
  const Hit hit = cast_right(outer, hole[from].at);
  if (!hit.found()) return false;
  std::size_t at = seen_from(outer, hole[from].at, hit);
  for (std::size_t i = 0; i < outer.size() && !opens_towards(outer, at, hole[from].at); ++i)
    if (outer[i].vertex == outer[at].vertex && opens_towards(outer, i, hole[from].at)) at = i;
  Loop joined(outer.begin(), outer.begin() + static_cast<std::ptrdiff_t>(at) + 1);
  for (std::size_t i = 0; i <= hole.size(); ++i) joined.push_back(hole[(from + i) % hole.size()]);
  joined.insert(joined.end(), outer.begin() + static_cast<std::ptrdiff_t>(at), outer.end());
  outer = std::move(joined);
  return true;
}

/// One loop, cut ear by ear.
class EarCutter {
 public:
  explicit EarCutter(Loop loop) : loop_(std::move(loop)) {
    double size = 0;
    for (const FlatPoint& p : loop_)
      size = std::max(size, (p.at - loop_[0].at).cwiseAbs().maxCoeff());
    slack_ = 1e-14 * size * size;
  }

  bool cut(std::vector<Triangle>& triangles) {
    while (loop_.size() > 3) {
      auto ear = best_ear(slack_);
      if (!ear) ear = best_ear(0);
      if (!ear) return false;
      emit(*ear, triangles);
      loop_.erase(loop_.begin() + static_cast<std::ptrdiff_t>(*ear));
    }
    emit(1, triangles);
    return true;
  }

 private:
  const FlatPoint& before(std::size_t i) const {
    return loop_[(i + loop_.size() - 1) % loop_.size()];
  }
  const FlatPoint& after(std::size_t i) const { return loop_[(i + 1) % loop_.size()]; }

  void emit(std::size_t i, std::vector<Triangle>& triangles) const {
    triangles.push_back({before(i).vertex, loop_[i].vertex, after(i).vertex});
  }

  /// Area by the square of the longest side: the fuller, the larger. Negative: no ear.
  double fullness(std::size_t i, double slack) const {
    const Vec2 &a = before(i).at, &b = loop_[i].at, &c = after(i).at;
    const double area = turn(a, b, c);
    if (area <= slack) return -1;
    return area / std::max({(b - a).squaredNorm(), (c - b).squaredNorm(), (a - c).squaredNorm()});
  }

  bool is_blocked(std::size_t i, double slack) const {
    const FlatPoint &a = before(i), &b = loop_[i], &c = after(i);
    for (const FlatPoint& p : loop_) {
      if (p.vertex == a.vertex || p.vertex == b.vertex || p.vertex == c.vertex) continue;
      if (turn(a.at, b.at, p.at) >= -slack && turn(b.at, c.at, p.at) >= -slack &&
          turn(c.at, a.at, p.at) >= -slack)
        return true;
    }
    return false;
  }

  std::optional<std::size_t> best_ear(double slack) {
    order_.clear();
    for (std::size_t i = 0; i < loop_.size(); ++i)
      if (const double full = fullness(i, slack); full > 0) order_.emplace_back(-full, i);
    std::make_heap(order_.begin(), order_.end(), std::greater<>());
    while (!order_.empty()) {
      std::pop_heap(order_.begin(), order_.end(), std::greater<>());
      if (!is_blocked(order_.back().second, slack)) return order_.back().second;
      order_.pop_back();
    }
    return std::nullopt;
  }

  Loop loop_;
  double slack_ = 0;
  std::vector<std::pair<double, std::size_t>> order_;
};

/// The smallest outer loop that holds the hole.
std::optional<std::size_t> home_of(const Loop& hole, const std::vector<Loop>& outers,
                                   const std::vector<double>& areas) {
  std::optional<std::size_t> home;
  for (std::size_t i = 0; i < outers.size(); ++i)
    if (holds(outers[i], hole[0].at) && (!home || areas[i] < areas[*home])) home = i;
  return home;
}

}  // namespace

bool fill_region(std::vector<FlatPoint> points, const std::vector<Side>& sides,
                 std::vector<Triangle>& triangles) {
  std::sort(points.begin(), points.end(),
            [](const FlatPoint& a, const FlatPoint& b) { return a.vertex < b.vertex; });
  auto loops = trace(points, sides);
  if (!loops) return false;
  std::vector<Loop> outers, holes;
  std::vector<double> areas;
  for (Loop& loop : *loops) {
    const double area = twice_area(loop);
    if (area > 0) areas.push_back(area);
    (area > 0 ? outers : holes).push_back(std::move(loop));
  }
  std::sort(holes.begin(), holes.end(), [](const Loop& a, const Loop& b) {
    return a[rightmost(a)].at.x() > b[rightmost(b)].at.x();
  });
  const std::vector<Loop> alone = outers;  // before bridges
  for (const Loop& hole : holes) {
    const auto home = home_of(hole, alone, areas);
    if (!home || !add_hole(outers[*home], hole)) return false;
  }
  for (Loop& outer : outers)
    if (!EarCutter(std::move(outer)).cut(triangles)) return false;
  return true;
}

}  // namespace osteon::tunnel
