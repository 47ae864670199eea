#include "tunnel_prism.h"

#include <algorithm>
#include <cmath>

namespace osteon::tunnel {
namespace {

constexpr double kSagitta_m = 0.25e-6;

/// A unit vector at right angles to `z`.
Vec3 across(const Vec3& z) {
  const Vec3 a = z.cwiseAbs();
  const Vec3 least = a.x() <= a.y() && a.x() <= a.z() ? Vec3::UnitX()
                     : a.y() <= a.z()                 ? Vec3::UnitY()
                                                      : Vec3::UnitZ();
  return z.cross(least).normalized();
}

// The radius of the prism's corners over that of the circle, for both to have the same area: then a
// shallow cut along a bone, whose width is many sides, is as deep on average as the cylinder's.
double same_area(int sides) {
  const double angle = 2 * M_PI / sides;
  return std::sqrt(angle / std::sin(angle));
}

}  // namespace

Frame::Frame(const Vec3& from, const Vec3& along)
    : origin(from), x(across(along.normalized())), z(along.normalized()) {
  y = z.cross(x);
}

int sides_for(double radius) {
  const double half_angle = std::acos(std::max(0.0, 1 - kSagitta_m / radius));
  const double sides = M_PI / std::max(half_angle, 1e-6);
  return 4 * static_cast<int>(std::ceil(std::clamp(sides, 96.0, 720.0) / 4));
}

Prism::Prism(double radius_m, double start_m, double end_m, const Placing& placing)
    : radius((radius_m + placing.radius_shift) * same_area(sides_for(radius_m))),
      start(start_m - placing.end_shift),
      end(end_m + placing.end_shift) {
  const int n = sides_for(radius_m);
  step = 2 * M_PI / n;
  first_angle = placing.phase * step;
  columns.reserve(static_cast<std::size_t>(n));
  for (int k = 0; k < n; ++k) {
    const double angle = first_angle + k * step;
    columns.emplace_back(radius * std::cos(angle), radius * std::sin(angle));
  }
}

int Prism::side_of(const Vec2& p) const {
  const double angle = std::atan2(p.y(), p.x()) - first_angle;
  return wrapped(static_cast<int>(std::floor(angle / step)));
}

double Prism::depth(int k, const Vec2& p) const {
  const Vec2& a = column(k);
  const Vec2& b = column(k + 1);
  return turn(a, b, p) / (b - a).norm();
}

}  // namespace osteon::tunnel
