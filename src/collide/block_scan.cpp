#include "block_scan.h"

#include <algorithm>
#include <array>
#include <limits>

#include "two_lanes.h"

namespace osteon {
namespace {

constexpr std::uint32_t kBlock = ConvexBody::kBlock;
constexpr std::size_t kChunk = 64;  // groups or runs whose bounds are held at a time
using Bounds = std::array<double, kChunk>;
constexpr double kLeast = -std::numeric_limits<double>::infinity();

// n.u - offset of two planes, always in this order of operations.
inline TwoLanes excess_of(const ConvexBody& body, std::size_t i, const ThreeLanes& u) {
  return TwoLanes::load(&body.nx[i]) * u.x + TwoLanes::load(&body.ny[i]) * u.y +
         TwoLanes::load(&body.nz[i]) * u.z - TwoLanes::load(&body.offset[i]);
}

inline TwoLanes height_of(const ConvexBody& body, std::size_t i, const ThreeLanes& n) {
  return TwoLanes::load(&body.vx[i]) * n.x + TwoLanes::load(&body.vy[i]) * n.y +
         TwoLanes::load(&body.vz[i]) * n.z;
}

inline TwoLanes plane_bound(const PlaneBlocks& b, std::size_t i, const ThreeLanes& u) {
  const TwoLanes middle = TwoLanes::load(&b.mid_x[i]) * u.x + TwoLanes::load(&b.mid_y[i]) * u.y +
                          TwoLanes::load(&b.mid_z[i]) * u.z + TwoLanes::load(&b.top[i]);
  return middle + TwoLanes::load(&b.half_x[i]) * abs(u.x - TwoLanes::load(&b.at_x[i])) +
         TwoLanes::load(&b.half_y[i]) * abs(u.y - TwoLanes::load(&b.at_y[i])) +
         TwoLanes::load(&b.half_z[i]) * abs(u.z - TwoLanes::load(&b.at_z[i]));
}

inline TwoLanes vertex_bound(const VertexBlocks& b, std::size_t i, const ThreeLanes& n) {
  return TwoLanes::load(&b.mid_x[i]) * n.x + TwoLanes::load(&b.mid_y[i]) * n.y +
         TwoLanes::load(&b.mid_z[i]) * n.z + TwoLanes::load(&b.half_x[i]) * abs(n.x) +
         TwoLanes::load(&b.half_y[i]) * abs(n.y) + TwoLanes::load(&b.half_z[i]) * abs(n.z);
}

// Largest value of a run, and the lowest index that has it when it beats `best`.
template <class Value>
void scan_run(std::size_t first, const Value& value, double& best, std::uint32_t& index) {
  TwoLanes even = value(first), odd = value(first + 2);
  for (std::size_t k = 4; k < kBlock; k += 4) {
    even = max(even, value(first + k));
    odd = max(odd, value(first + k + 2));
  }
  const double largest = max(even, odd).top();
  if (!(largest > best)) return;
  best = largest;
  for (std::size_t k = first;; k += 2) {
    std::array<double, 2> pair;
    value(k).store(pair.data());
    if (pair[0] != largest && pair[1] != largest) continue;
    index = static_cast<std::uint32_t>(pair[0] == largest ? k : k + 1);
    return;
  }
}

// Index of the first of `count` bounds that equals `value`.
std::size_t find(const Bounds& bounds, double value) {
  std::size_t k = 0;
  while (bounds[k] != value) ++k;
  return k;
}

// Calls `visit` with each of `count` members from `first` on whose bound beats the best so far, the
// most promising first. At most kChunk members.
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

// Scans the runs whose bounds, and their groups', beat the best so far. A bound that a pair repeats
// behind the last member is that member's.
template <class GroupBound, class RunBound, class Value>
void scan_promising(std::size_t runs, const GroupBound& group_bound, const RunBound& run_bound,
                    const Value& value, double& best, std::uint32_t& index) {
  constexpr std::size_t kFew = 2 * ConvexBody::kGroupRuns;
  const auto scan = [&](std::size_t run) { scan_run(run * kBlock, value, best, index); };
  if (runs <= kFew) return visit_promising(0, runs, run_bound, best, scan);
  const auto open = [&](std::size_t group) {
    const std::size_t first = group * ConvexBody::kGroupRuns;
    const std::size_t count = std::min<std::size_t>(ConvexBody::kGroupRuns, runs - first);
    visit_promising(first, count, run_bound, best, scan);
  };
  const std::size_t groups = (runs + ConvexBody::kGroupRuns - 1) / ConvexBody::kGroupRuns;
  for (std::size_t base = 0; base < groups; base += kChunk)
    visit_promising(base, std::min(kChunk, groups - base), group_bound, best, open);
}

template <std::size_t N>
Vec3 middle_and_half(const std::vector<double>* const (&axes)[N], std::size_t first,
                     std::size_t count, Vec3& half) {
  Vec3 mid;
  for (std::size_t j = 0; j < N; ++j) {
    const auto begin = axes[j]->begin() + static_cast<std::ptrdiff_t>(first);
    const auto [lo, hi] = std::minmax_element(begin, begin + static_cast<std::ptrdiff_t>(count));
    const auto axis = static_cast<Eigen::Index>(j);
    mid[axis] = 0.5 * (*lo + *hi);
    half[axis] = 0.5 * (*hi - *lo);
  }
  return mid;
}

void push(std::vector<double>& x, std::vector<double>& y, std::vector<double>& z, const Vec3& v) {
  x.push_back(v.x());
  y.push_back(v.y());
  z.push_back(v.z());
}

// Bounds of `count` planes from `first` on.
void add_plane_bounds(const ConvexBody& body, std::size_t first, std::size_t count,
                      const std::vector<Vec3>& facet_points, PlaneBlocks& out) {
  Vec3 half;
  const Vec3 mid = middle_and_half<3>({&body.nx, &body.ny, &body.nz}, first, count, half);
  Vec3 at = Vec3::Zero();
  for (std::size_t i = first; i < first + count; ++i)
    at += (facet_points[std::min(i, facet_points.size() - 1)] - body.center) /
          static_cast<double>(count);
  double beyond = kLeast;
  for (std::size_t i = first; i < first + count; ++i)
    beyond = std::max(beyond, body.normal(static_cast<std::uint32_t>(i)).dot(at) - body.offset[i]);
  push(out.mid_x, out.mid_y, out.mid_z, mid);
  push(out.half_x, out.half_y, out.half_z, half);
  push(out.at_x, out.at_y, out.at_z, at);
  out.top.push_back(beyond - mid.dot(at));
}

void add_vertex_bounds(const ConvexBody& body, std::size_t first, std::size_t count,
                       VertexBlocks& out) {
  Vec3 half;
  const Vec3 mid = middle_and_half<3>({&body.vx, &body.vy, &body.vz}, first, count, half);
  push(out.mid_x, out.mid_y, out.mid_z, mid);
  push(out.half_x, out.half_y, out.half_z, half);
}

// Repeats the last run so that bounds can be read two at a time.
template <class... Arrays>
void pad_to_even(Arrays&... arrays) {
  ((arrays.size() % 2 == 1 ? arrays.push_back(arrays.back()) : void()), ...);
}

}  // namespace

Excess most_exceeded(const ConvexBody& body, const Vec3& u, double floor) {
  const ThreeLanes lanes(u);
  Excess found{floor, Excess::kNone};
  scan_promising(
      body.nx.size() / kBlock,
      [&](std::size_t i) { return plane_bound(body.plane_groups, i, lanes); },
      [&](std::size_t i) { return plane_bound(body.plane_blocks, i, lanes); },
      [&](std::size_t i) { return excess_of(body, i, lanes); }, found.value, found.plane);
  return found;
}

Excess first_exceeded(const ConvexBody& body, const Vec3& u, double floor) {
  const ThreeLanes lanes(u);
  for (std::uint32_t i = 0; i < body.plane_count; i += 2) {
    std::array<double, 2> values;
    excess_of(body, i, lanes).store(values.data());
    if (values[0] > floor) return {values[0], i};
    if (values[1] > floor) return {values[1], i + 1};
  }
  return {floor, Excess::kNone};
}

namespace {

// Largest height of a small body's vertices, all of them looked at. What is not a number does not
// count.
double highest_of_all(const ConvexBody& body, const ThreeLanes& n) {
  TwoLanes even = TwoLanes::both(kLeast), odd = even;
  for (std::size_t i = 0; i < body.vx.size(); i += 4) {
    even = max(height_of(body, i, n), even);
    odd = max(height_of(body, i + 2, n), odd);
  }
  return max(even, odd).top();
}

}  // namespace

double support(const ConvexBody& body, const Vec3& n, std::uint32_t* vertex) {
  constexpr std::size_t kSmall = 3 * kBlock;
  const ThreeLanes lanes(n);
  if (!vertex && body.vx.size() <= kSmall) return highest_of_all(body, lanes);
  double best = kLeast;
  std::uint32_t index = 0;
  scan_promising(
      body.vx.size() / kBlock,
      [&](std::size_t i) { return vertex_bound(body.vertex_groups, i, lanes); },
      [&](std::size_t i) { return vertex_bound(body.vertex_blocks, i, lanes); },
      [&](std::size_t i) { return height_of(body, i, lanes); }, best, index);
  if (vertex) *vertex = index;
  return best;
}

void make_blocks(ConvexBody& body, const std::vector<Vec3>& facet_points) {
  const auto each = [](std::size_t size, std::size_t step, const auto& add) {
    for (std::size_t i = 0; i < size; i += step) add(i, std::min(step, size - i));
  };
  for (PlaneBlocks* b : {&body.plane_blocks, &body.plane_groups}) {
    const std::size_t step = b == &body.plane_blocks ? kBlock : ConvexBody::kGroup;
    each(body.nx.size(), step, [&](std::size_t first, std::size_t count) {
      add_plane_bounds(body, first, count, facet_points, *b);
    });
    pad_to_even(b->mid_x, b->mid_y, b->mid_z, b->half_x, b->half_y, b->half_z, b->at_x, b->at_y,
                b->at_z, b->top);
  }
  for (VertexBlocks* b : {&body.vertex_blocks, &body.vertex_groups}) {
    const std::size_t step = b == &body.vertex_blocks ? kBlock : ConvexBody::kGroup;
    each(body.vx.size(), step,
         [&](std::size_t first, std::size_t count) { add_vertex_bounds(body, first, count, *b); });
    pad_to_even(b->mid_x, b->mid_y, b->mid_z, b->half_x, b->half_y, b->half_z);
  }
}

}  // namespace osteon
