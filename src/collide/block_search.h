#pragma once

// How runs of planes and vertices are searched: two values at a time, runs and groups of runs
// skipped by their bounds.

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "osteon/collide/convex_body.h"
#include "two_lanes.h"

namespace osteon::block_search {

inline constexpr std::uint32_t kRun = ConvexBody::kBlock;
inline constexpr std::size_t kChunk = 64;  // groups or runs whose bounds are held at a time
inline constexpr double kLeast = -std::numeric_limits<double>::infinity();
using Bounds = std::array<double, kChunk>;

/// n.u - offset of planes i and i + 1, always in this order of operations.
struct PlaneExcess {
  const ConvexBody& body;
  const ThreeLanes& u;
  TwoLanes operator()(std::size_t i) const {
    return TwoLanes::load(&body.nx[i]) * u.x + TwoLanes::load(&body.ny[i]) * u.y +
           TwoLanes::load(&body.nz[i]) * u.z - TwoLanes::load(&body.offset[i]);
  }
};

/// n.v of vertices i and i + 1.
struct VertexHeight {
  const ConvexBody& body;
  const ThreeLanes& n;
  TwoLanes operator()(std::size_t i) const {
    return TwoLanes::load(&body.vx[i]) * n.x + TwoLanes::load(&body.vy[i]) * n.y +
           TwoLanes::load(&body.vz[i]) * n.z;
  }
};

/// What no plane of blocks i and i + 1 exceeds.
struct PlaneBound {
  const PlaneBlocks& b;
  const ThreeLanes& u;
  TwoLanes operator()(std::size_t i) const {
    const TwoLanes middle = TwoLanes::load(&b.mid_x[i]) * u.x + TwoLanes::load(&b.mid_y[i]) * u.y +
                            TwoLanes::load(&b.mid_z[i]) * u.z + TwoLanes::load(&b.top[i]);
    return middle + TwoLanes::load(&b.half_x[i]) * abs(u.x - TwoLanes::load(&b.at_x[i])) +
           TwoLanes::load(&b.half_y[i]) * abs(u.y - TwoLanes::load(&b.at_y[i])) +
           TwoLanes::load(&b.half_z[i]) * abs(u.z - TwoLanes::load(&b.at_z[i]));
  }
};

/// What no vertex of blocks i and i + 1 exceeds.
struct VertexBound {
  const VertexBlocks& b;
  const ThreeLanes& n;
  TwoLanes operator()(std::size_t i) const {
    return TwoLanes::load(&b.mid_x[i]) * n.x + TwoLanes::load(&b.mid_y[i]) * n.y +
           TwoLanes::load(&b.mid_z[i]) * n.z + TwoLanes::load(&b.half_x[i]) * abs(n.x) +
           TwoLanes::load(&b.half_y[i]) * abs(n.y) + TwoLanes::load(&b.half_z[i]) * abs(n.z);
  }
};

/// Largest value of run `run`.
template <class Value>
double run_top(std::size_t run, const Value& value) {
  const std::size_t first = run * kRun;
  TwoLanes even = value(first), odd = value(first + 2);
  for (std::size_t k = 4; k < kRun; k += 4) {
    even = max(even, value(first + k));
    odd = max(odd, value(first + k + 2));
  }
  return max(even, odd).top();
}

/// Largest value of run `run`, and the lowest index that has it, when it beats `best`.
template <class Value>
void scan_run(std::size_t run, const Value& value, double& best, std::uint32_t& index) {
  const double largest = run_top(run, value);
  if (!(largest > best)) return;
  best = largest;
  for (std::size_t k = run * kRun;; k += 2) {
    std::array<double, 2> pair;
    value(k).store(pair.data());
    if (pair[0] != largest && pair[1] != largest) continue;
    index = static_cast<std::uint32_t>(pair[0] == largest ? k : k + 1);
    return;
  }
}

/// Index of the first of the bounds that equals `value`.
inline std::size_t find(const Bounds& bounds, double value) {
  std::size_t k = 0;
  while (bounds[k] != value) ++k;
  return k;
}

/// Calls `visit` with each of `count` members from `first` on whose bound beats the best so far,
/// the most promising first. At most kChunk members.
template <class Bound, class Visit>
void visit_promising(std::size_t first, std::size_t count, const Bound& bound, const double& best,
                     const Visit& visit) {
  Bounds bounds;
  TwoLanes top = TwoLanes::both(kLeast);
  for (std::size_t k = 0; k < count; k += 2) {
    const TwoLanes pair = bound(first + k);
    pair.store(&bounds[k]);
    top = max(top, pair);
  }
  if (!(top.top() > best)) return;
  const std::size_t most = find(bounds, top.top());
  visit(first + most);
  bounds[most] = kLeast;
  for (std::size_t k = 0; k < count; k += 2) {
    const int open = above(TwoLanes::load(&bounds[k]), TwoLanes::both(best));
    if (open & 1) visit(first + k);
    if (open & 2 && k + 1 < count) visit(first + k + 1);
  }
}

/// Calls `visit` with each run whose bound, and its group's, beats the best so far. A bound that a
/// pair repeats behind the last member is that member's.
template <class GroupBound, class RunBound, class Visit>
void visit_runs(std::size_t runs, const GroupBound& group_bound, const RunBound& run_bound,
                const double& best, const Visit& visit) {
  constexpr std::size_t kFew = 2 * ConvexBody::kGroupRuns;
  if (runs <= kFew) return visit_promising(0, runs, run_bound, best, visit);
  const auto open = [&](std::size_t group) {
    const std::size_t first = group * ConvexBody::kGroupRuns;
    const std::size_t count = std::min<std::size_t>(ConvexBody::kGroupRuns, runs - first);
    visit_promising(first, count, run_bound, best, visit);
  };
  const std::size_t groups = (runs + ConvexBody::kGroupRuns - 1) / ConvexBody::kGroupRuns;
  for (std::size_t base = 0; base < groups; base += kChunk)
    visit_promising(base, std::min(kChunk, groups - base), group_bound, best, open);
}

/// The runs of a body's planes that a point u (from its centre) may exceed by more than `best`.
template <class Visit>
void visit_plane_runs(const ConvexBody& body, const ThreeLanes& u, const double& best,
                      const Visit& visit) {
  visit_runs(body.nx.size() / kRun, PlaneBound{body.plane_groups, u},
             PlaneBound{body.plane_blocks, u}, best, visit);
}

/// The runs of a body's vertices that may stand higher along n than `best`.
template <class Visit>
void visit_vertex_runs(const ConvexBody& body, const ThreeLanes& n, const double& best,
                       const Visit& visit) {
  visit_runs(body.vx.size() / kRun, VertexBound{body.vertex_groups, n},
             VertexBound{body.vertex_blocks, n}, best, visit);
}

/// The most promising of `count` members from `first` on.
template <class Bound>
std::size_t most_promising(std::size_t first, std::size_t count, const Bound& bound) {
  TwoLanes top = bound(first);
  std::size_t at = first;
  double best = top.top();
  for (std::size_t k = 2; k < count; k += 2) {
    const double pair = bound(first + k).top();
    at = pair > best ? first + k : at;
    best = std::max(best, pair);
  }
  std::array<double, 2> pair;
  bound(at).store(pair.data());
  return pair[1] > pair[0] && at + 1 < first + count ? at + 1 : at;
}

/// The one run that promises most by its group's bound and its own.
inline std::size_t promising_plane_run(const ConvexBody& body, const ThreeLanes& u) {
  constexpr std::size_t kRuns = ConvexBody::kGroupRuns;
  const std::size_t runs = body.nx.size() / kRun, groups = (runs + kRuns - 1) / kRuns;
  std::size_t first = 0, count = runs;
  if (groups > 2) {
    first = kRuns * most_promising(0, groups, PlaneBound{body.plane_groups, u});
    count = std::min(kRuns, runs - first);
  }
  return most_promising(first, count, PlaneBound{body.plane_blocks, u});
}

}  // namespace osteon::block_search
