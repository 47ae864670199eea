#include "bone/nearby_surface.h"

namespace osteon {

std::optional<ClosestPoint> NearbySurface::nearer_than(double limit, const Vec3& p) {
  constexpr double kRounding_m = 1e-12;
  // The way to the last point, squared, so that most answers need no root.
  const double spare = at_last_.signed_distance - limit - kRounding_m;
  if (spare > 0 && (p - last_).squaredNorm() < spare * spare) return std::nullopt;
  at_last_ = surface_->closest(p, at_last_.triangle);
  last_ = p;
  return at_last_;
}

}  // namespace osteon
