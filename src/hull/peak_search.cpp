#include "peak_search.h"

#include <algorithm>
#include <cmath>

#include "osteon/mesh/longest_edge.h"

namespace osteon::hull {
namespace {

constexpr std::size_t kMostNodes = std::size_t{1} << 21;  // 50 MB
constexpr std::uint64_t kWorkOfClosest = 20;              // a look into the tree of boxes
constexpr double kRounding = 1 + 1e-6;                    // also that of a float

}  // namespace

std::uint32_t KnownHeights::make(std::uint32_t count) {
  nodes.resize(nodes.size() + count);
  return static_cast<std::uint32_t>(nodes.size() - count);
}

std::uint32_t KnownHeights::root_of(const Corners& facet) {
  if (nodes.size() > kMostNodes) {
    nodes.clear();
    roots.clear();
  }
  const auto [root, made] = roots.find_or_make(facet);
  if (made) root = make(1);
  return root;
}

void PeakSearch::search(const Corners& t, std::uint32_t at) {
  if (best_.need > enough_ || grid_.worn_out()) return;
  const double most = value_.most(t);
  if (most * known_.nodes[at].most <= best_.need) return;
  const Vec3 middle = (t[0] + t[1] + t[2]) / 3;
  double way = 0;
  for (const Vec3& corner : t) way = std::max(way, (corner - middle).norm());
  // The grid's heights are good to a part of a cell, and quicker.
  if (most * (grid_.at(middle) + 0.5 * grid_.cell() + way) <= bar()) return;
  double height = known_.nodes[at].height;
  const bool is_new = std::isnan(height);
  if (is_new) {
    if (stays_below(t, most, at)) return;
    grid_.spend(kWorkOfClosest);
    const ClosestPoint found = grid_.exact().closest(middle, last_);
    height = found.signed_distance;
    known_.nodes[at].height = height;
    known_.nodes[at].near = found.triangle;
  }
  last_ = known_.nodes[at].near;
  best_.raise(height * value_.at(middle), height, middle);
  if (most * (height + way) <= bar()) return;
  if (is_new && stays_below(t, most, at)) return;
  search_halves(t, at);
}

void PeakSearch::search_halves(const Corners& t, std::uint32_t at) {
  if (known_.nodes[at].halves == 0) {
    const std::uint32_t halves = known_.make(2);
    known_.nodes[at].halves = halves;
  }
  const std::uint32_t first = known_.nodes[at].halves;
  const std::size_t longest = longest_edge(t).from;
  const Vec3& a = t[longest];
  const Vec3& b = t[(longest + 1) % 3];
  const Vec3& c = t[(longest + 2) % 3];
  const Vec3 half = 0.5 * (a + b);
  search({a, half, c}, first);
  search({half, b, c}, first + 1);
}

/// Above it something is still looked for.
double PeakSearch::bar() const {
  return std::max(floor_, best_.need) + std::max(kPeakError_m, 0.05 * best_.need);
}

/// True when no place of the triangle needs more than is known. The distance to one triangle of the
/// mesh is convex, so over `t` it is largest at a corner, and that to the mesh is no larger.
bool PeakSearch::stays_below(const Corners& t, double most, std::uint32_t at) {
  double farthest = 0;
  for (const Vec3& corner : t) {
    farthest = std::max(farthest, kRounding * grid_.exact().distance_to(corner, last_));
    if (most * farthest > best_.need) return false;
  }
  known_.nodes[at].most = static_cast<float>(farthest * kRounding);
  return true;
}

}  // namespace osteon::hull
