#include "polygon.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "exact/predicates.h"

namespace osteon::hull {

Projection projection_of(const Cloud& cloud, std::uint32_t a, std::uint32_t b, std::uint32_t c) {
  const Vec3 e1 = cloud.scaled(b) - cloud.scaled(a);
  const Vec3 e2 = cloud.scaled(c) - cloud.scaled(a);
  Eigen::Index steepest = 0;
  e1.cross(e2).cwiseAbs().maxCoeff(&steepest);
  for (int k = 0; k < 3; ++k) {
    const int i = (static_cast<int>(steepest) + k + 1) % 3;
    const int j = (i + 1) % 3;
    const int turn =
        orient2d(cloud.raw(a), cloud.raw(b), cloud.raw(c), i, j, cloud.exact_counter());
    if (turn > 0) return {i, j};
    if (turn < 0) return {j, i};
  }
  assert(false && "the points are collinear");
  return {};
}

// Andrew's monotone chains ("Another efficient algorithm for convex hulls in two dimensions",
// 1979).
std::vector<std::uint32_t> wrap_polygon(const Cloud& cloud, std::vector<std::uint32_t> points,
                                        std::uint32_t a, std::uint32_t b, std::uint32_t c) {
  const auto [i, j] = projection_of(cloud, a, b, c);
  const int axis_i = i, axis_j = j;
  std::sort(points.begin(), points.end(), [&](std::uint32_t p, std::uint32_t q) {
    const Vec3& x = cloud.raw(p);
    const Vec3& y = cloud.raw(q);
    return x[axis_i] != y[axis_i] ? x[axis_i] < y[axis_i] : x[axis_j] < y[axis_j];
  });
  std::vector<std::uint32_t> chain;
  const auto extend = [&](std::uint32_t p, std::size_t fixed) {
    while (chain.size() > fixed &&
           orient2d(cloud.raw(chain[chain.size() - 2]), cloud.raw(chain.back()), cloud.raw(p),
                    axis_i, axis_j, cloud.exact_counter()) <= 0) {
      chain.pop_back();
    }
    chain.push_back(p);
  };
  for (const std::uint32_t p : points) extend(p, 1);
  const std::size_t lower = chain.size();
  for (std::size_t k = points.size() - 1; k-- > 0;) extend(points[k], lower);
  chain.pop_back();
  return chain;
}

}  // namespace osteon::hull
