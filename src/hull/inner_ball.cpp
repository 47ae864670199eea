#include "inner_ball.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>

#include "quickhull.h"

namespace osteon::hull {

namespace {

/// A smaller cloud gains nothing.
constexpr std::size_t kSmall = 2000;
/// Enough points to find far-out ones among.
constexpr std::size_t kSample = 16384;
/// Rounding of frame E is far below this.
constexpr double kMargin = 1e-9;
/// Cells along an edge of each face of a cube around the middle.
constexpr int kCells = 10;

/// From the input's frame to E, where the box has sides of 2 about the origin.
struct ToCube {
  Vec3 centre, factor;
  Vec3 operator()(const Vec3& p) const { return (p - centre).cwiseProduct(factor); }
};

ToCube to_cube(std::span<const Vec3> points) {
  Vec3 lo = points[0], hi = lo;
  for (const Vec3& p : points) {
    lo = lo.cwiseMin(p);
    hi = hi.cwiseMax(p);
  }
  // A cloud that is flat along an axis, or too wide for doubles, has no usable ball: its points
  // come out as not a number and are kept.
  return {0.5 * lo + 0.5 * hi, (0.5 * hi - 0.5 * lo).cwiseInverse()};
}

/// Cell of a direction on the cube around the middle; the point is not the middle itself.
int cell_of(const Vec3& q_E) {
  const Vec3 a = q_E.cwiseAbs();
  const int axis = a.x() >= a.y() ? (a.x() >= a.z() ? 0 : 2) : (a.y() >= a.z() ? 1 : 2);
  const double inverse = 0.5 * kCells / a[axis];
  const auto place = [&](double x) {
    return std::clamp(static_cast<int>(x * inverse + 0.5 * kCells), 0, kCells - 1);
  };
  const int face = 2 * axis + (q_E[axis] < 0 ? 1 : 0);
  return (face * kCells + place(q_E[(axis + 1) % 3])) * kCells + place(q_E[(axis + 2) % 3]);
}

/// Of a sample, the point farthest from the middle in each cell that has one.
std::vector<Vec3> far_points(std::span<const Vec3> points, const ToCube& cube) {
  std::array<double, 6 * kCells * kCells> square{};
  std::vector<Vec3> farthest(square.size());
  const std::size_t stride = std::max<std::size_t>(1, points.size() / kSample);
  for (std::size_t i = 0; i < points.size(); i += stride) {
    const Vec3 q_E = cube(points[i]);
    const double here = q_E.squaredNorm();
    if (!(here > 0.1 && here < 4)) continue;  // deep inside, or not a number
    const auto cell = static_cast<std::size_t>(cell_of(q_E));
    if (here <= square[cell]) continue;
    square[cell] = here;
    farthest[cell] = q_E;
  }
  std::size_t count = 0;
  for (std::size_t cell = 0; cell < square.size(); ++cell) {
    if (square[cell] > 0) farthest[count++] = farthest[cell];
  }
  farthest.resize(count);
  return farthest;
}

/// Radius of a ball about the origin that lies within the hull of the points; 0 when there is none.
/// The filter's bound holds for every point of its frame, so for those of the ball.
double inner_radius(const std::vector<Vec3>& points_E) {
  if (points_E.size() < 4) return 0;
  const Cloud cloud(points_E);
  const Shell shell = quickhull(cloud);
  if (shell.failure) return 0;
  const Vec3 origin_S = cloud.to_scaled(Vec3::Zero());
  double radius_S = std::numeric_limits<double>::infinity();
  for (const Shell::Facet& f : shell.facets)
    radius_S = std::min(radius_S, -f.plane.height(origin_S) - f.plane.bound);
  return std::max(0.0, radius_S / cloud.scale() - kMargin);
}

}  // namespace

std::vector<std::uint32_t> outside_inner_ball(std::span<const Vec3> points) {
  std::vector<std::uint32_t> kept(points.size());
  if (points.size() < kSmall) {
    std::iota(kept.begin(), kept.end(), 0u);
    return kept;
  }
  const ToCube cube = to_cube(points);
  const double radius = inner_radius(far_points(points, cube));
  const double square = radius * radius;
  std::size_t count = 0;
  for (std::uint32_t i = 0; i < points.size(); ++i) {
    kept[count] = i;
    count += cube(points[i]).squaredNorm() < square ? 0 : 1;
  }
  kept.resize(count);
  return kept;
}

}  // namespace osteon::hull
