#include "inner_reach.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <span>

#include "cube_map.h"

namespace osteon::hull {

namespace {

/// Rounding, of a polytope with no worse bounds than the second, is far below the first.
constexpr double kReachMargin = 1e-5;
constexpr double kWorstBound = 1e-6;

std::uint32_t cells_of_table(std::size_t points) {
  const double cells = std::sqrt(static_cast<double>(points)) / 8;
  return static_cast<std::uint32_t>(std::clamp(cells, 4.0, 48.0));
}

/// Of the corners of a face's cells, row by row.
std::vector<double> corner_rises(Polytope& polytope, std::uint32_t face, std::uint32_t cells) {
  std::vector<double> rises;
  for (std::uint32_t row = 0; row <= cells; ++row) {
    for (std::uint32_t column = 0; column <= cells; ++column) {
      const double u = 2.0 * column / cells - 1, v = 2.0 * row / cells - 1;
      rises.push_back(polytope.highest_rise(on_cube(face, u, v)));
    }
  }
  return rises;
}

/// The largest w.q on each cell of the cube, by cell_of.
std::vector<double> cell_rises(Polytope& polytope, std::uint32_t cells) {
  std::vector<double> rises;
  for (std::uint32_t face = 0; face < 6; ++face) {
    const std::vector<double> corners = corner_rises(polytope, face, cells);
    for (std::uint32_t row = 0; row < cells; ++row) {
      for (std::uint32_t column = 0; column < cells; ++column) {
        const double* low = &corners[row * (cells + 1) + column];
        const double* high = low + cells + 1;
        rises.push_back(std::max(std::max(low[0], low[1]), std::max(high[0], high[1])));
      }
    }
  }
  return rises;
}

/// An ellipsoid inside, with the axes of the cloud's box: a point is in when |q / box|^2 is less.
struct InnerBall {
  Vec3 factor;
  double square;
};

InnerBall inner_ball(const Cloud& cloud, const Polytope& polytope) {
  InnerBall ball;
  ball.factor = (polytope.to_q(cloud.box().hi) - polytope.to_q(cloud.box().lo)).cwiseInverse();
  double steepest = 0;
  for (const Polytope::Facet& f : polytope.facets()) {
    if (f.gone()) continue;
    const Vec3 w(f.wx, f.wy, f.wz);
    steepest = std::max(steepest, w.cwiseQuotient(ball.factor).squaredNorm());
  }
  ball.square = (1 - kReachMargin) / steepest;
  return ball;
}

}  // namespace

std::vector<std::uint32_t> outside_reach(const Cloud& cloud, Polytope& polytope) {
  std::vector<std::uint32_t> kept(cloud.size());
  if (!(polytope.worst_bound() < kWorstBound)) {
    std::iota(kept.begin(), kept.end(), 0u);
    return kept;
  }
  const InnerBall ball = inner_ball(cloud, polytope);
  std::size_t count = 0;
  for (std::uint32_t i = 0; i < cloud.size(); ++i) {
    const Vec3 q = polytope.to_q(cloud.raw(i)).cwiseProduct(ball.factor);
    kept[count] = i;
    count += q.squaredNorm() < ball.square ? 0 : 1;
  }
  kept.resize(count);
  const std::uint32_t cells = cells_of_table(count);
  const std::vector<double> rises = cell_rises(polytope, cells);
  std::size_t left = 0;
  for (const std::uint32_t i : kept) {
    const CubeSpot spot = cube_spot(polytope.to_q(cloud.raw(i)));
    kept[left] = i;
    left += spot.reach * rises[cell_of(spot, cells)] < 1 - kReachMargin ? 0 : 1;
  }
  kept.resize(left);
  return kept;
}

}  // namespace osteon::hull
