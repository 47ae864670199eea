// Symbols: f_k >= 0, force of contact k along its normal; A_kj, how far the lip goes there for each
// newton of contact j; c, what the lip's own skin yields; s_k, how far the disc stands over it.
// Wanted: (A + c) f >= s where f > 0 it is equal. The matrix is symmetric and positive, so rounds
// of single balances end at the one solution (Gauss and Seidel, projected); their number is
// bounded.
#include "osteon/tissue/sheet_lips.h"

#include <algorithm>
#include <cmath>

#include "osteon/base/union_find.h"

namespace osteon {
namespace {

constexpr int kLipRounds = 200;
constexpr double kLipEnough_n = 1e-9;
constexpr double kLipFar_m = 0.020;  // lips so far from a disc do not come to it

SheetPoint left_of(const SheetPoint& way) { return SheetPoint(-way.y(), way.x()).normalized(); }

}  // namespace

Eigen::Matrix2d SheetLips::yields(std::size_t lip, std::size_t pushed) const {
  const std::size_t n = copy_.size();
  Eigen::Matrix2d out;
  for (std::size_t axis = 0; axis < 2; ++axis)
    for (std::size_t d = 0; d < 2; ++d)
      out(static_cast<Eigen::Index>(d), static_cast<Eigen::Index>(axis)) =
          yields_[((2 * pushed + axis) * n + lip) * 2 + d];
  return out;
}

LipWork::LipWork(std::shared_ptr<const SheetYield> yields) : from_(std::move(yields)) {
  const SplitSheet& split = from_->split();
  constexpr std::uint32_t kNone = 0xffffffffu;
  std::vector<std::uint32_t> lip_of(split.vertex.size(), kNone);
  const auto lip = [&](std::uint32_t copy) {
    if (lip_of[copy] == kNone && out_->copy_.size() < SheetLips::kMost) {
      lip_of[copy] = static_cast<std::uint32_t>(out_->copy_.size());
      out_->copy_.push_back(copy);
      out_->rest_.push_back(split.point[copy] + from_->ways()[copy]);
    }
    return lip_of[copy];
  };
  std::vector<SheetPoint> out(split.vertex.size(), SheetPoint::Zero());
  std::vector<int> walls_at(split.vertex.size(), 0);
  for (const SheetWall& wall : split.walls)
    for (const std::uint32_t copy : {wall.from, wall.to}) {
      out[copy] += left_of(split.point[wall.to] - split.point[wall.from]);
      ++walls_at[copy];
    }
  UnionFind joined(split.vertex.size());
  // The two sides of an edge go opposite ways between the same vertices.
  for (std::size_t i = 0; i < split.walls.size(); ++i)
    for (std::size_t j = i + 1; j < split.walls.size(); ++j) {
      const SheetWall &one = split.walls[i], &two = split.walls[j];
      if (one.from_base != two.to_base || one.to_base != two.from_base) continue;
      const std::uint32_t from = lip(one.from), to = lip(one.to);
      const std::uint32_t to_other = lip(two.from), from_other = lip(two.to);
      if (std::max({from, to, to_other, from_other}) == kNone) continue;
      SheetLips::Edge edge;
      edge.a = split.point[one.from];
      edge.way = split.point[one.to] - edge.a;
      edge.slit = one.from_base;
      // Where a slit ends both of its sides meet, and their mean has no side.
      const SheetPoint side = left_of(edge.way);
      const auto mean = [&](std::uint32_t copy, const SheetPoint& mine) {
        return out[copy].dot(mine) > 0.5 ? SheetPoint(out[copy].normalized()) : mine;
      };
      edge.sides[0] = {{from, to}, {mean(one.from, side), mean(one.to, side)}};
      edge.sides[1] = {{from_other, to_other}, {mean(two.to, -side), mean(two.from, -side)}};
      joined.join(one.from_base, one.to_base);
      out_->edges_.push_back(edge);
      if (one.from == two.to)
        out_->ends_.push_back({from, edge.a, -edge.way.normalized(), edge.slit});
      if (one.to == two.from)
        out_->ends_.push_back({to, edge.a + edge.way, edge.way.normalized(), edge.slit});
    }
  for (SheetLips::Edge& edge : out_->edges_) edge.slit = joined.find(edge.slit);
  for (SheetLips::End& end : out_->ends_) end.slit = joined.find(end.slit);
  out_->yields_.assign(4 * out_->copy_.size() * out_->copy_.size(), 0);
  ways_.resize(out_->copy_.size());
}

bool LipWork::step() {
  const std::size_t n = out_->copy_.size();
  if (done_ == 2 * n) return true;
  from_->pull_one(out_->copy_[done_ / 2], static_cast<int>(done_ % 2), out_->copy_, scratch_,
                  ways_);
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t d = 0; d < 2; ++d)
      out_->yields_[(done_ * n + i) * 2 + d] = ways_[i][static_cast<Eigen::Index>(d)];
  return ++done_ == 2 * n;
}

namespace {

void add_push(const SheetLips& lips, const LipDisc& disc, LipPush push, LipPushes& out) {
  SheetPoint lip = SheetPoint::Zero();
  for (std::size_t k = 0; k < 2; ++k) lip += push.share[k] * lips.rest(push.lip[k]);
  push.deep_m = push.out.dot(disc.at - lip) + disc.radius_m;
  push.hand = disc.hand;
  if (push.deep_m > -kLipFar_m && out.count < LipPushes::kMost) out.all[out.count++] = push;
}

struct OnEdge {
  const SheetLips::Edge* edge = nullptr;
  double at = 0;
};

OnEdge nearest_edge(const SheetLips& lips, const SheetPoint& p) {
  OnEdge best;
  double nearest = 1e300;
  for (const SheetLips::Edge& edge : lips.edges()) {
    const double t = std::clamp((p - edge.a).dot(edge.way) / edge.way.squaredNorm(), 0.0, 1.0);
    const double far = (p - edge.a - t * edge.way).squaredNorm();
    if (!(far < nearest)) continue;
    nearest = far;
    best = {&edge, t};
  }
  return best;
}

// The edge that is nearest to the disc, and the ends of its slit. At an end a disc pushes the end
// before it: the lips that it parts are those a radius from there.
void meet(const SheetLips& lips, const LipDisc& disc, LipPushes& out) {
  const OnEdge near = nearest_edge(lips, disc.at);
  if (!near.edge) return;
  SheetPoint p = disc.at;
  for (const SheetLips::End& end : lips.ends()) {
    if (end.slit != near.edge->slit) continue;
    p -= std::max(0.0, end.out.dot(disc.at - end.at) + disc.radius_m) * end.out;
    LipPush push;
    push.lip = {end.lip, end.lip};
    push.share = {1, 0};
    push.out = end.out;
    push.at = end.at;
    add_push(lips, disc, push, out);
  }
  const OnEdge between = nearest_edge(lips, p);
  for (const SheetLips::Side& side : between.edge->sides) {
    LipPush push;
    push.lip = side.lip;
    push.share = {1 - between.at, between.at};
    push.out = ((1 - between.at) * side.out[0] + between.at * side.out[1]).normalized();
    push.at = between.edge->a + between.at * between.edge->way;
    add_push(lips, disc, push, out);
  }
}

double coupled(const SheetLips& lips, const LipPush& one, const LipPush& two) {
  double sum = 0;
  for (std::size_t a = 0; a < 2; ++a)
    for (std::size_t b = 0; b < 2; ++b)
      if (one.share[a] > 0 && two.share[b] > 0)
        sum += one.share[a] * two.share[b] *
               one.out.dot(lips.yields(one.lip[a], two.lip[b]) * two.out);
  return sum;
}

}  // namespace

void press_lips(const SheetLips& lips, std::span<const LipDisc> discs, double surface_n_per_m,
                LipPushes& out) {
  out.count = 0;
  for (const LipDisc& disc : discs) meet(lips, disc, out);
  const std::size_t n = out.count;
  std::array<double, LipPushes::kMost * LipPushes::kMost> A;  // the first n rows are used
  for (std::size_t k = 0; k < n; ++k)
    for (std::size_t j = 0; j <= k; ++j)
      A[k * n + j] = A[j * n + k] = coupled(lips, out.all[k], out.all[j]);
  for (int round = 0; round < kLipRounds; ++round) {
    double most = 0;
    for (std::size_t k = 0; k < n; ++k) {
      LipPush& push = out.all[k];
      double missing = push.deep_m - push.force_n / surface_n_per_m;
      for (std::size_t j = 0; j < n; ++j) missing -= A[k * n + j] * out.all[j].force_n;
      const double was = push.force_n;
      push.force_n = std::max(0.0, was + missing / (A[k * n + k] + 1 / surface_n_per_m));
      most = std::max(most, std::abs(push.force_n - was));
    }
    if (most < kLipEnough_n) break;
  }
  for (std::size_t k = 0; k < n; ++k) {
    out.all[k].moved_m = 0;
    for (std::size_t j = 0; j < n; ++j) out.all[k].moved_m += A[k * n + j] * out.all[j].force_n;
  }
}

SheetPoint lip_way(const SheetLips& lips, const LipPushes& pushes, std::size_t lip) {
  SheetPoint sum = SheetPoint::Zero();
  for (const LipPush& push : pushes.list())
    for (std::size_t k = 0; k < 2; ++k)
      if (push.share[k] > 0)
        sum += push.share[k] * push.force_n * (lips.yields(lip, push.lip[k]) * push.out);
  return sum;
}

}  // namespace osteon
