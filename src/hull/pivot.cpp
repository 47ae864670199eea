#include "pivot.h"

namespace osteon::hull {

namespace {
constexpr std::uint32_t kNone = 0xffffffffu;
}

const Contact& Pivot::turn(std::uint32_t from, std::uint32_t to, std::uint32_t guess) {
  from_ = from;
  to_ = to;
  take(guess);
  if (!turn_to_triangle()) gather();
  return contact_;
}

/// Every point seen so far is below the new plane, except for those on the edge's line.
void Pivot::take(std::uint32_t point) {
  contact_.point = point;
  contact_.others.clear();
  plane_ = survivors_.plane(from_, to_, point);
  ++turns_;
}

/// False when the facet may have more corners than three.
bool Pivot::turn_to_triangle() {
  const std::uint32_t first = foremost(neighbours_.of(from_));
  if (first != kNone) take(first);
  for (;;) {
    const Finding at_from = settle(neighbours_.of(from_));
    if (at_from == Finding::kOnPlane) return false;
    if (at_from == Finding::kTurned) continue;
    const Finding at_to = settle(neighbours_.of(to_));
    if (at_to != Finding::kTurned) return at_to == Finding::kAllBelow;
  }
}

/// Of the points above the plane, the one that turns it furthest, as far as rounding tells. A point
/// at height h over the plane and d ahead of the edge turns it by atan2(h, d).
std::uint32_t Pivot::foremost(std::span<const std::uint32_t> points) const {
  const Vec3& origin_S = survivors_.scaled(from_);
  const Vec3 along_S = survivors_.scaled(to_) - origin_S;
  const Vec3 ahead_S = Vec3(plane_.nx, plane_.ny, plane_.nz).cross(along_S);
  const double ahead_d = ahead_S.dot(origin_S);
  std::uint32_t best = kNone;
  double best_height = 0, best_ahead = 0;
  for (const std::uint32_t p : points) {
    const Vec3& q_S = survivors_.scaled(p);
    const double height = plane_.height(q_S);
    if (!(height > plane_.bound)) continue;
    const double ahead = ahead_S.dot(q_S) - ahead_d;
    if (best != kNone && !(height * best_ahead > best_height * ahead)) continue;
    best = p;
    best_height = height;
    best_ahead = ahead;
  }
  return best;
}

/// Takes the first point above the plane, or tells whether one is on it; exact.
Pivot::Finding Pivot::settle(std::span<const std::uint32_t> points) {
  bool on_plane = false;
  for (const std::uint32_t p : points) {
    const double height = plane_.height(survivors_.scaled(p));
    if (height < -plane_.bound || is_mine(p)) continue;
    const int side =
        height > plane_.bound ? 1 : survivors_.exact_side(from_, to_, contact_.point, p);
    if (side > 0) {
      take(p);
      return Finding::kTurned;
    }
    on_plane = on_plane || side == 0;
  }
  return on_plane ? Finding::kOnPlane : Finding::kAllBelow;
}

/// All survivors on the plane; turns it further should one be above.
void Pivot::gather() {
  if (!tree_) tree_.emplace(survivors_, shell_);
  stack_.assign(1, {0, turns_ - 1});
  while (!stack_.empty()) {
    const Waiting waiting = stack_.back();
    stack_.pop_back();
    const PointTree::Node& node = tree_->node(waiting.node);
    if (waiting.turns != turns_ && !may_reach(node.highest(plane_))) continue;
    if (node.leaf()) {
      scan(node);
      continue;
    }
    const std::uint32_t left = waiting.node + 1;
    if (may_reach(tree_->node(node.right).highest(plane_))) stack_.push_back({node.right, turns_});
    if (may_reach(tree_->node(left).highest(plane_))) stack_.push_back({left, turns_});
  }
}

void Pivot::scan(const PointTree::Node& leaf) {
  double heights[PointTree::kLeafSize];
  tree_->heights(leaf.begin, plane_, heights);
  const std::uint32_t turns = turns_;
  for (std::uint32_t place = leaf.begin; place < leaf.end; ++place) {
    const std::uint32_t p = tree_->point_at(place);
    const bool below = turns == turns_ && heights[place - leaf.begin] < -plane_.bound;
    if (below || is_mine(p)) continue;
    const int side = survivors_.exact_side(from_, to_, contact_.point, p);
    if (side > 0) take(p);
    if (side == 0) contact_.others.push_back(p);
  }
}

}  // namespace osteon::hull
