#include "tunnel_edges.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace osteon::tunnel {
namespace {

/// An edge that comes no nearer than this to the circle says nothing about columns.
constexpr double kFar_m = 2e-6;

/// Where the line from a to b goes through the side in the wanted sense, between its columns.
std::optional<Crossing> cross_side(const Prism& prism, int side, const Vec2& a, const Vec2& b,
                                   bool entering) {
  const double da = prism.depth(side, a), db = prism.depth(side, b);
  if (entering ? !(da < 0 && db > 0) : !(da > 0 && db < 0)) return std::nullopt;
  const double t = da / (da - db);
  const Vec2 p = a + t * (b - a);
  const Vec2 along = prism.column(side + 1) - prism.column(side);
  const double s = (p - prism.column(side)).dot(along);
  if (s < 0 || s >= along.squaredNorm()) return std::nullopt;
  return Crossing{t, prism.wrapped(side), 0, entering};
}

/// The same, of the sides about the one through which the line goes where it crosses the circle.
std::optional<Crossing> cross_near(const Prism& prism, const Vec2& at, const Vec2& a, const Vec2& b,
                                   bool entering) {
  const int middle = prism.side_of(at);
  for (const int step : {0, -1, 1})
    if (const auto found = cross_side(prism, middle + step, a, b, entering)) return found;
  return std::nullopt;
}

}  // namespace

EdgeTable::EdgeTable(Patch& patch, const Prism& prism)
    : clearance_(std::numeric_limits<double>::infinity()) {
  sort_points(patch, prism);
  for (const EdgeKey& key : edges_within(patch)) cross(patch, prism, key);
  for (CrossedEdge& edge : crossed_)
    for (std::size_t i = 0; i < edge.count; ++i) {
      const Vec3 a = patch.points_A[edge.key.lo], b = patch.points_A[edge.key.hi];
      edge.crossings[i].point = static_cast<std::uint32_t>(patch.points_A.size());
      Vec3 p = a + edge.crossings[i].t * (b - a);
      if (a.z() == b.z()) p.z() = a.z();
      patch.points_A.push_back(p);
    }
}

void EdgeTable::sort_points(const Patch& patch, const Prism& prism) {
  inside_.assign(patch.points_A.size(), 2);
  for (const Facet& f : patch.facets) {
    if (!f.near || f.layer != Layer::kWithin) continue;
    for (const std::uint32_t v : f.v) {
      if (inside_[v] != 2) continue;
      const Vec2 p = flat(patch.points_A[v]);
      const double depth = prism.depth(prism.side_of(p), p);
      clearance_ = std::min(clearance_, std::abs(depth));
      inside_[v] = depth > 0;
    }
  }
  for (std::uint8_t& in : inside_) in = in == 1;
}

std::vector<EdgeKey> EdgeTable::edges_within(const Patch& patch) const {
  std::vector<EdgeKey> keys;
  for (const Facet& f : patch.facets)
    if (f.near && f.layer == Layer::kWithin)
      for (std::size_t k = 0; k < 3; ++k)
        if (!inside_[f.v[k]] || !inside_[f.v[(k + 1) % 3]])
          keys.emplace_back(f.v[k], f.v[(k + 1) % 3]);
  std::sort(keys.begin(), keys.end());
  keys.erase(std::unique(keys.begin(), keys.end()), keys.end());
  return keys;
}

void EdgeTable::keep_clear(const Prism& prism, int side, const Vec2& a, const Vec2& b) {
  const double length = (b - a).norm();
  for (const int k : {side, side + 1})
    clearance_ = std::min(clearance_, std::abs(turn(a, b, prism.column(k))) / length);
}

// Symbols: the edge is a + t d, 0 <= t <= 1, in the plane across the axis; |a + t d|^2 = r^2 has
// the roots t1 <= t2. The prism's corners lie on the circle, so that between a side and its arc
// nothing else of the prism lies: a line enters the prism through the side that it meets the circle
// over, or not at all.
void EdgeTable::cross(const Patch& patch, const Prism& prism, const EdgeKey& key) {
  const Vec2 a = flat(patch.points_A[key.lo]), b = flat(patch.points_A[key.hi]);
  const bool in_a = inside(key.lo), in_b = inside(key.hi);
  const Vec2 d = b - a;
  const double dd = d.squaredNorm();
  if (dd == 0) return;  // along the axis
  const double foot = -a.dot(d) / dd;
  const Vec2 nearest = a + foot * d;
  if (nearest.norm() > prism.radius + kFar_m || (!in_a && !in_b && (foot <= 0 || foot >= 1))) {
    sound_ = sound_ && in_a == in_b;
    return;
  }
  if (foot > 0 && foot < 1 && nearest.norm() > prism.radius - kFar_m)
    keep_clear(prism, prism.side_of(nearest), a, b);
  const double half2 = (prism.radius * prism.radius - nearest.squaredNorm()) / dd;
  std::optional<Crossing> in, out;
  if (half2 > 0) {
    const double half = std::sqrt(half2);
    if (!in_a) in = cross_near(prism, a + (foot - half) * d, a, b, true);
    if (!in_b) out = cross_near(prism, a + (foot + half) * d, a, b, false);
  }
  const bool must_enter = !in_a && in_b, must_leave = in_a && !in_b;
  if ((must_enter && !in) || (must_leave && !out) || (!in_a && !in_b && !in != !out)) {
    sound_ = false;
    return;
  }
  if (!in && !out) return;
  CrossedEdge edge{key, 0, {}};
  for (const auto& c : {in, out})
    if (c) {
      keep_clear(prism, c->side, a, b);
      edge.crossings[edge.count++] = *c;
    }
  sound_ = sound_ && (edge.count < 2 || edge.crossings[0].t < edge.crossings[1].t);
  crossed_.push_back(edge);
}

const CrossedEdge* EdgeTable::find(std::uint32_t a, std::uint32_t b) const {
  const EdgeKey key(a, b);
  const auto at =
      std::lower_bound(crossed_.begin(), crossed_.end(), key,
                       [](const CrossedEdge& e, const EdgeKey& wanted) { return e.key < wanted; });
  return at != crossed_.end() && at->key == key ? &*at : nullptr;
}

}  // namespace osteon::tunnel
