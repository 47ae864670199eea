#include "initial_simplex.h"

#include <cmath>
#include <utility>

#include "exact/predicates.h"

namespace osteon::hull {

namespace {

constexpr std::uint32_t kNone = 0xffffffffu;

std::pair<std::uint32_t, std::uint32_t> extremes(const Cloud& cloud) {
  std::uint32_t lo = 0, hi = 0;
  for (std::uint32_t i = 1; i < cloud.size(); ++i) {
    if (lexicographic_less(cloud.raw(i), cloud.raw(lo))) lo = i;
    if (lexicographic_less(cloud.raw(hi), cloud.raw(i))) hi = i;
  }
  return {lo, hi};
}

/// The point that looks farthest from the line a b; any point off the line if that one is on it.
std::uint32_t farthest_from_line(const Cloud& cloud, std::uint32_t a, std::uint32_t b) {
  const Vec3 along = cloud.scaled(b) - cloud.scaled(a);
  std::uint32_t best = a;
  double best_square = -1;
  for (std::uint32_t i = 0; i < cloud.size(); ++i) {
    const double square = along.cross(cloud.scaled(i) - cloud.scaled(a)).squaredNorm();
    if (square > best_square) {
      best = i;
      best_square = square;
    }
  }
  const auto off_line = [&](std::uint32_t i) {
    return !collinear(cloud.raw(a), cloud.raw(b), cloud.raw(i), cloud.exact_counter());
  };
  if (off_line(best)) return best;
  for (std::uint32_t i = 0; i < cloud.size(); ++i) {
    if (off_line(i)) return i;
  }
  return kNone;
}

/// The same for the plane a b c.
std::uint32_t farthest_from_plane(const Cloud& cloud, std::uint32_t a, std::uint32_t b,
                                  std::uint32_t c) {
  const FilterPlane plane = cloud.plane(a, b, c);
  std::uint32_t best = a;
  double best_height = -1;
  for (std::uint32_t i = 0; i < cloud.size(); ++i) {
    const double h = std::abs(plane.height(cloud.scaled(i)));
    if (h > best_height) {
      best = i;
      best_height = h;
    }
  }
  if (best_height > plane.bound || cloud.exact_side(a, b, c, best) != 0) return best;
  for (std::uint32_t i = 0; i < cloud.size(); ++i) {
    if (cloud.exact_side(a, b, c, i) != 0) return i;
  }
  return kNone;
}

}  // namespace

Simplex find_simplex(const Cloud& cloud) {
  const auto [a, b] = extremes(cloud);
  if (cloud.raw(a) == cloud.raw(b)) return {{}, HullFailure::kAllAtOnePoint};
  const std::uint32_t c = farthest_from_line(cloud, a, b);
  if (c == kNone) return {{}, HullFailure::kAllOnALine};
  const std::uint32_t d = farthest_from_plane(cloud, a, b, c);
  if (d == kNone) return {{}, HullFailure::kAllInAPlane};
  if (cloud.exact_side(a, b, c, d) > 0) return {{a, b, c, d}, std::nullopt};
  return {{a, c, b, d}, std::nullopt};
}

}  // namespace osteon::hull
