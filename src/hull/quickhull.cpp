#include "quickhull.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <utility>

#include "cube_map.h"
#include "inner_reach.h"

namespace osteon::hull {

namespace {

/// The points of a smaller cloud are added in less time than it takes to sort some of them out:
/// in a ball the sorting pays from 3000 points on, in a thin shell from 16 000.
constexpr std::size_t kSmallCloud = 5000;
/// Enough points to find a good simplex among.
constexpr std::size_t kSimplexSample = 512;

/// Enough points to find far-out ones among.
std::size_t far_sample(std::size_t points) {
  return std::clamp<std::size_t>(points / 8, 2048, 32768);
}

/// Every so many-th point.
std::vector<std::uint32_t> sample(std::size_t points, std::size_t count) {
  const std::size_t stride = std::max<std::size_t>(1, points / count);
  std::vector<std::uint32_t> taken;
  taken.reserve(points / stride + 1);
  for (std::size_t i = 0; i < points; i += stride) taken.push_back(static_cast<std::uint32_t>(i));
  return taken;
}

/// Of some points where these will do, else of all.
Simplex simplex_of(const Cloud& cloud) {
  if (cloud.size() > 2 * kSimplexSample) {
    const std::vector<std::uint32_t> taken = sample(cloud.size(), kSimplexSample);
    std::vector<Vec3> points;
    for (const std::uint32_t i : taken) points.push_back(cloud.raw(i));
    const Cloud few(points, finite_box(points));
    Simplex simplex = find_simplex(few);
    for (std::uint32_t& corner : simplex.corners) corner = taken[corner];
    if (!simplex.failure) return simplex;
  }
  return find_simplex(cloud);
}

/// Cells along an edge of each face of the cube of directions; even.
std::uint32_t cells_for(std::size_t points) {
  const auto cells = static_cast<std::uint32_t>(0.4 * std::sqrt(std::sqrt(double(points))));
  return std::clamp(2 * cells, 4u, 20u);
}

struct FarPoint {
  double square = 0;  ///< of the distance from the origin of Q
  std::uint32_t point = kNoIndex;
};

/// Of a sample, the point farthest out in each cell of directions.
std::vector<FarPoint> far_points(const Cloud& cloud, const Polytope& polytope,
                                 std::uint32_t cells) {
  std::vector<FarPoint> farthest(6 * cells * cells);
  for (const std::uint32_t i : sample(cloud.size(), far_sample(cloud.size()))) {
    const Vec3 q = polytope.to_q(cloud.raw(i));
    const double square = q.squaredNorm();
    if (!(square > 0.01)) continue;
    FarPoint& here = farthest[cell_of(cube_spot(q), cells)];
    if (square > here.square) here = {square, i};
  }
  return farthest;
}

/// The farthest of each quarter of a face first: the corners of a box and its like, so that points
/// within its faces make none of their own.
void grow(Polytope& polytope, std::vector<FarPoint>& farthest, std::uint32_t cells) {
  std::array<FarPoint*, 24> first{};
  for (std::uint32_t cell = 0; cell < farthest.size(); ++cell) {
    const std::uint32_t face = cell / (cells * cells);
    const std::uint32_t row = cell / cells % cells, column = cell % cells;
    FarPoint*& here = first[(face * 2 + 2 * row / cells) * 2 + 2 * column / cells];
    if (!here || farthest[cell].square > here->square) here = &farthest[cell];
  }
  const auto take = [&](FarPoint& far) {
    if (far.point != kNoIndex) polytope.add(far.point);
    far.point = kNoIndex;
  };
  for (FarPoint* far : first) take(*far);
  for (FarPoint& far : farthest) take(far);
}

}  // namespace

// Symbols: Q is the polar frame about a point inside, in which the polytope's planes are w.q = 1.
// Invariant: the polytope is the convex hull of its vertices, which are points of the cloud; what
// is discarded lies inside it, so no corner of the cloud's hull is lost. Source: Barber, Dobkin and
// Huhdanpaa 1996. Ends: every far point is added once, and every other point is looked at once.
FirstStage quickhull(const Cloud& cloud) {
  FirstStage result;
  const Simplex simplex = simplex_of(cloud);
  if (simplex.failure) {
    result.failure = *simplex.failure;
    return result;
  }
  result.polytope.emplace(cloud, simplex.corners);
  if (cloud.size() < kSmallCloud) {
    result.points.resize(cloud.size());
    std::iota(result.points.begin(), result.points.end(), 0u);
    return result;
  }
  const std::uint32_t cells = cells_for(cloud.size());
  std::vector<FarPoint> farthest = far_points(cloud, *result.polytope, cells);
  grow(*result.polytope, farthest, cells);
  result.points = outside_reach(cloud, *result.polytope);
  return result;
}

}  // namespace osteon::hull
