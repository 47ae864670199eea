#include "osteon/procedure/polyline.h"

#include <algorithm>
#include <cstddef>
#include <limits>

namespace osteon {

double distance_to_polyline(std::span<const Vec3> places, const Vec3& p) {
  double least = std::numeric_limits<double>::infinity();
  if (places.size() == 1) return (p - places[0]).norm();
  for (std::size_t i = 1; i < places.size(); ++i) {
    const Vec3 way = places[i] - places[i - 1];
    const double square = way.squaredNorm();
    const Vec3 from = p - places[i - 1];
    const double share = square > 0 ? std::clamp(from.dot(way) / square, 0.0, 1.0) : 0;
    least = std::min(least, (from - share * way).norm());
  }
  return least;
}

}  // namespace osteon
