#include "friction.h"

#include <algorithm>

namespace osteon {
namespace {

double length(std::span<const Vec3> path) {
  double sum = 0;
  for (std::size_t i = 1; i < path.size(); ++i) sum += (path[i] - path[i - 1]).norm();
  return sum;
}

// The point of the path that lies `lag` before its end.
Vec3 behind_end(std::span<const Vec3> path, double lag) {
  for (std::size_t i = path.size(); i-- > 1;) {
    const double piece = (path[i] - path[i - 1]).norm();
    if (lag < piece) return path[i] + (lag / piece) * (path[i - 1] - path[i]);
    lag -= piece;
  }
  return path.front();
}

}  // namespace

FrictionStep apply_friction(std::span<const Vec3> path, const Friction& friction,
                            bool was_sliding) {
  const double dynamic_lag = std::min(friction.dynamic_lag_m, friction.static_lag_m);
  const double limit = was_sliding ? dynamic_lag : friction.static_lag_m;
  const double way = length(path);
  if (limit > 0 && way <= limit) return {path.front(), true, false};
  constexpr double kShare = 0.05;
  const double glide = friction.glide_m + kShare * way;
  const double lag = std::max(dynamic_lag, way - glide);
  return {lag > 0 ? behind_end(path, lag) : path.back(), false, friction.static_lag_m > 0};
}

}  // namespace osteon
