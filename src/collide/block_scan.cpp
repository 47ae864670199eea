#include "block_scan.h"

#include <algorithm>
#include <array>

#include "block_search.h"

namespace osteon {
namespace {

using namespace block_search;

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
  const PlaneExcess excess{body, lanes};
  Excess found{floor, Excess::kNone};
  visit_plane_runs(body, lanes, found.value,
                   [&](std::size_t run) { scan_run(run, excess, found.value, found.plane); });
  return found;
}

Excess likely_exceeded(const ConvexBody& body, const Vec3& u, double floor) {
  const ThreeLanes lanes(u);
  Excess found{floor, Excess::kNone};
  scan_run(promising_plane_run(body, lanes), PlaneExcess{body, lanes}, found.value, found.plane);
  return found;
}

Excess first_exceeded(const ConvexBody& body, const Vec3& u, double floor) {
  const ThreeLanes lanes(u);
  const PlaneExcess excess{body, lanes};
  for (std::uint32_t i = 0; i < body.plane_count; i += 2) {
    std::array<double, 2> values;
    excess(i).store(values.data());
    if (values[0] > floor) return {values[0], i};
    if (values[1] > floor) return {values[1], i + 1};
  }
  return {floor, Excess::kNone};
}

namespace {

// Largest height of a small body's vertices, all of them looked at. What is not a number does not
// count.
double highest_of_all(const ConvexBody& body, const ThreeLanes& n) {
  const VertexHeight height{body, n};
  TwoLanes even = TwoLanes::both(kLeast), odd = even;
  for (std::size_t i = 0; i < body.vx.size(); i += 4) {
    even = max(height(i), even);
    odd = max(height(i + 2), odd);
  }
  return max(even, odd).top();
}

}  // namespace

double support(const ConvexBody& body, const Vec3& n, std::uint32_t* vertex) {
  constexpr std::size_t kSmall = 3 * kRun;
  const ThreeLanes lanes(n);
  if (!vertex && body.vx.size() <= kSmall) return highest_of_all(body, lanes);
  const VertexHeight height{body, lanes};
  double best = kLeast;
  std::uint32_t index = 0;
  visit_vertex_runs(body, lanes, best,
                    [&](std::size_t run) { scan_run(run, height, best, index); });
  if (vertex) *vertex = index;
  return best;
}

void make_blocks(ConvexBody& body, const std::vector<Vec3>& facet_points) {
  const auto each = [](std::size_t size, std::size_t step, const auto& add) {
    for (std::size_t i = 0; i < size; i += step) add(i, std::min(step, size - i));
  };
  for (PlaneBlocks* b : {&body.plane_blocks, &body.plane_groups}) {
    const std::size_t step = b == &body.plane_blocks ? kRun : ConvexBody::kGroup;
    each(body.nx.size(), step, [&](std::size_t first, std::size_t count) {
      add_plane_bounds(body, first, count, facet_points, *b);
    });
    pad_to_even(b->mid_x, b->mid_y, b->mid_z, b->half_x, b->half_y, b->half_z, b->at_x, b->at_y,
                b->at_z, b->top);
  }
  for (VertexBlocks* b : {&body.vertex_blocks, &body.vertex_groups}) {
    const std::size_t step = b == &body.vertex_blocks ? kRun : ConvexBody::kGroup;
    each(body.vx.size(), step,
         [&](std::size_t first, std::size_t count) { add_vertex_bounds(body, first, count, *b); });
    pad_to_even(b->mid_x, b->mid_y, b->mid_z, b->half_x, b->half_y, b->half_z);
  }
}

}  // namespace osteon
